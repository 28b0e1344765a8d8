"""GoalUpdatedController of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.goal_updated_controller import GoalUpdatedController


def test_the_child_is_ticked_at_the_start_and_at_each_new_goal() -> None:
    trial = Trial(GoalUpdatedController, 'goal="{here}"', children="S", here=1, goals=[1])
    assert trial.tick() + trial.again() == "SR"
    trial["here"] = 2
    assert trial.again() + trial.again() == "SR"
    trial["goals"] = [2]  # the entry, since there is no port
    assert trial.again() + trial.again() == "SR"
    assert trial.child_ticks == 3


def test_a_running_child_is_ticked_at_every_tick() -> None:
    trial = Trial(GoalUpdatedController, children="RRF")
    assert trial.tick() + trial.tick() + trial.tick() == "RRF"
