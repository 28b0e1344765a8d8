"""Ages of values, by a clock that does not jump."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest

from backend.sessions.idleness import Ages

HOUR = timedelta(hours=1)


class Clocks:
    """A wall clock that can be set, and one that cannot."""

    def __init__(self):
        self.wall, self.steady = datetime(2026, 1, 1, tzinfo=UTC), 1000.0

    def pass_(self, span):
        self.wall += span
        self.steady += span.total_seconds()

    def ages(self):
        return Ages(lambda: self.wall, lambda: self.steady)


@pytest.mark.parametrize("jump", [3 * HOUR, -3 * HOUR])
def test_a_clock_that_is_set_makes_nothing_older_or_younger(jump):
    clocks = Clocks()
    ages, began = clocks.ages(), clocks.wall
    assert ages.of({"a": began}) == {"a": timedelta(0)}
    clocks.pass_(HOUR)
    clocks.wall += jump
    assert ages.of({"a": began, "b": began}) == {"a": HOUR, "b": timedelta(0)}
    clocks.pass_(HOUR)
    used = clocks.wall
    assert ages.of({"a": used, "b": began}) == {"a": timedelta(0), "b": HOUR}


def test_another_time_is_another_value_and_its_age_is_that_of_the_time():
    clocks = Clocks()
    ages = clocks.ages()
    ages.of({"a": clocks.wall})
    clocks.pass_(HOUR)
    assert ages.of({"a": clocks.wall - HOUR / 2}) == {"a": HOUR / 2}
    assert ages.of({"a": clocks.wall + HOUR}) == {"a": timedelta(0)}, "as one server's clock is ahead"


def test_what_is_seen_first_can_have_a_greatest_age():
    clocks = Clocks()
    ages = clocks.ages()
    assert ages.of({"a": clocks.wall - HOUR}, at_first=HOUR / 2) == {"a": HOUR / 2}
    assert ages.of({"a": clocks.wall - 2 * HOUR}, at_first=HOUR / 2) == {"a": 2 * HOUR}
    assert ages.of({}) == {}
    assert ages.of({"a": clocks.wall - HOUR}, at_first=HOUR / 2) == {"a": HOUR / 2}
