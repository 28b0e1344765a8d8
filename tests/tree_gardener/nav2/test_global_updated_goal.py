"""GlobalUpdatedGoal of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.global_updated_goal import GlobalUpdatedGoal


def test_it_succeeds_at_first_and_at_each_change_also_after_resets() -> None:
    trial = Trial(GlobalUpdatedGoal, goal=1, goals=[1])
    assert trial.tick() + trial.tick() + trial.again() == "SFF"
    trial["goal"] = 2
    assert trial.tick() + trial.tick() == "SF"
    trial["goals"] = [2]
    assert trial.tick() + trial.tick() == "SF"
