"""GoalReached of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial, pose
from tree_gardener.nav2.goal_reached import GoalReached


def test_it_succeeds_within_the_tolerance_in_the_frame_of_the_goal() -> None:
    ros = RosNode()
    trial = Trial(GoalReached, 'goal="{goal}"', ros=ros, goal=pose(1.0))
    assert trial.tick() == "F"
    ros.place(0.7)
    assert trial.tick() == "F"
    ros.place(0.75)
    assert trial.tick() == "S"
    assert Trial(GoalReached, 'goal="{goal}"', ros=ros).tick() == "F"


def test_the_tolerance_is_a_parameter() -> None:
    ros = RosNode(goal_reached_tol=1.0)
    trial = Trial(GoalReached, 'goal="{goal}"', ros=ros, goal=pose(1.0))
    ros.place(0.0)
    assert trial.tick() == "S"
