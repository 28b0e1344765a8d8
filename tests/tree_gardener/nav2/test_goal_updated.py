"""GoalUpdated of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.goal_updated import GoalUpdated


def test_it_remembers_the_goals_at_the_start_and_succeeds_at_each_change() -> None:
    trial = Trial(GoalUpdated, 'goal="{here}"', here=1, goals=[1])
    assert trial.tick() + trial.again() == "FF"
    trial["here"] = 2
    assert trial.again() + trial.again() == "SF"
    trial["goals"] = [2]
    assert trial.again() + trial.again() == "SF"
    trial["here"] = 3
    assert trial.tick() == "F"
