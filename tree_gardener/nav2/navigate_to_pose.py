"""NavigateToPose of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import pose_from
from tree_gardener.ports import Port


class NavigateToPose(Nav2Action):
    """Drives the robot to a pose.

    Rule: Nav2's plugins/action/navigate_to_pose_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/NavigateToPose"
    ACTION_NAME = "navigate_to_pose"
    INPUT_PORTS = {
        "goal": Port(description="The goal; a text is x;y;yaw in the map."),
        "behavior_tree": Port(
            str, description="The tree of the navigator; the built-in navigation has none."
        ),
        "server_name": Port(str, description="Name of the action; navigate_to_pose if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.pose = pose_from(self.read("goal"))
        if self.is_given("behavior_tree"):
            goal.behavior_tree = str(self.read("behavior_tree"))
