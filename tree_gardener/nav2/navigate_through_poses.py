"""NavigateThroughPoses of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import poses_from
from tree_gardener.ports import Port


class NavigateThroughPoses(Nav2Action):
    """Drives the robot over poses.

    Rule: Nav2's plugins/action/navigate_through_poses_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/NavigateThroughPoses"
    ACTION_NAME = "navigate_through_poses"
    INPUT_PORTS = {
        "goals": Port(description="The goals; as a text, x;y;yaw with | between them."),
        "behavior_tree": Port(
            str, description="The tree of the navigator; the built-in navigation has none."
        ),
        "server_name": Port(
            str, description="Name of the action; navigate_through_poses if it is not given."
        ),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        poses = poses_from(self.read("goals"))
        if hasattr(goal.poses, "goals"):
            goal.poses.goals = poses
        else:
            goal.poses = poses
        if self.is_given("behavior_tree"):
            goal.behavior_tree = str(self.read("behavior_tree"))
