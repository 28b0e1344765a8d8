"""The sizes to plan with, and the simulated day."""

from __future__ import annotations

import pytest

from tests.benchmarks.capacity import LESSON_S, LESSONS_H, SAVE_PERIOD_S, Size, school_day


def test_sizes_are_the_costs_times_the_numbers() -> None:
    school = Size(10_000, 1_500)
    assert school.saves_a_second == pytest.approx(10_000 / SAVE_PERIOD_S)
    assert (school.web_cores, school.executor_cores, school.database_cores) == (40, 743, 6)
    assert Size(1, 1).web_cores == 2, "one may fail"


def test_everybody_has_a_robot_at_once_where_there_are_as_many_places() -> None:
    day = school_day(people=30, places=30, start_s=2.0)
    assert len(day.waits_s) == 30 * len(LESSONS_H)
    assert day.longest_queue == 0
    assert set(map(round, day.waits_s)) == {2}


def test_fewer_places_make_people_wait_but_never_longer_than_the_lesson() -> None:
    few, many = school_day(60, 10, 1.0), school_day(60, 30, 1.0)
    assert few.wait_95_s > many.wait_95_s
    assert few.longest_queue > many.longest_queue
    assert max(few.waits_s) <= LESSON_S + 1.0
    assert few.core_hours * 3 == pytest.approx(many.core_hours)


def test_a_day_is_repeatable() -> None:
    assert school_day(20, 5, 1.0) == school_day(20, 5, 1.0)
    assert school_day(20, 5, 1.0) != school_day(20, 5, 1.0, seed=2)
