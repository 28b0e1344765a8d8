"""FollowPath of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action, put
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port
from tree_gardener.status import Status


class FollowPath(Nav2Action):
    """Follows a path; when the entry changes, it follows the new one without a stop.

    Rule: Nav2's plugins/action/follow_path_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/FollowPath"
    ACTION_NAME = "follow_path"
    INPUT_PORTS = {
        "path": Port(description="The path."),
        "controller_id": Port(str, description="The controller."),
        "goal_checker_id": Port(str, description="The goal checker."),
        "progress_checker_id": Port(str, description="The progress checker."),
        "path_handler_id": Port(str, description="The path handler."),
        "server_name": Port(str, description="Name of the action; follow_path if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "tracking_feedback": Port(description="The state of the controller, if its version reports it."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    path: Any = None

    def set_goal(self, goal: Any) -> None:
        self.path = goal.path = self.read("path")
        for name in ("controller_id", "goal_checker_id", "progress_checker_id", "path_handler_id"):
            if self.is_given(name):
                put(goal, **{name: str(self.read(name))})

    def is_changed(self) -> bool:
        path = self.read("path")
        return path is not self.path and path != self.path

    def on_feedback(self, feedback: Any) -> Status:
        if hasattr(feedback, "tracking_feedback"):
            give(self, "tracking_feedback", feedback.tracking_feedback)
        return Status.RUNNING
