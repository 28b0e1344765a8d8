"""AppendGoalPoseToGoals of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial, goals, pose, xs
from tree_gardener.nav2.append_goal_pose_to_goals import AppendGoalPoseToGoals

PORTS = 'goal_pose="{pose}" input_goals="{goals}" output_goals="{new}"'


def test_the_pose_is_appended_to_a_copy() -> None:
    trial = Trial(AppendGoalPoseToGoals, PORTS, pose=pose(3.0), goals=goals(1.0, 2.0))
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [1.0, 2.0, 3.0]
    assert xs(trial["goals"]) == [1.0, 2.0]
    assert trial["new"].header == trial["goals"].header


def test_without_pose_or_goals_it_fails() -> None:
    assert Trial(AppendGoalPoseToGoals, PORTS, pose=pose(3.0)).tick() == "F"
    assert Trial(AppendGoalPoseToGoals, PORTS, goals=goals()).tick() == "F"
