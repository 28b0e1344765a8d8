"""TimeExpired of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.time_expired import TimeExpired


def test_it_succeeds_each_time_that_the_time_has_passed() -> None:
    trial = Trial(TimeExpired, 'seconds="{time}"', time=2.0)
    assert trial.tick() == "F"
    trial["time"] = 9.0  # it was read at the start
    trial.clock.advance(1.9)
    assert trial.again() == "F"
    trial.clock.advance(0.1)
    assert trial.again() + trial.again() == "SF"
    trial.clock.advance(2.0)
    assert trial.again() == "S"
    trial.clock.advance(2.0)
    assert trial.tick() == "F"
