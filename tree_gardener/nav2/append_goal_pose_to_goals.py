"""AppendGoalPoseToGoals of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.geometry import copied
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.ports import Port


class AppendGoalPoseToGoals(Behaviour):
    """Writes the goals with one more pose at the end. It fails if there are no goals or no pose.

    Rule: Nav2's plugins/action/append_goal_pose_to_goals_action.cpp, which appends an empty pose instead.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "goal_pose": Port(description="The pose to append."),
        "input_goals": Port(description="The goals."),
    }
    OUTPUT_PORTS = {"output_goals": Port(description="The goals with the pose.")}

    def update(self) -> Status:
        pose, goals = input_or(self, "goal_pose", None), input_or(self, "input_goals", None)
        if pose is None or goals is None:
            return Status.FAILURE
        give(self, "output_goals", copied(goals, goals=[*goals.goals, pose]))
        return Status.SUCCESS
