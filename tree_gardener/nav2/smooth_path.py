"""SmoothPath of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import duration
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port
from tree_gardener.status import Status


class SmoothPath(Nav2Action):
    """Smooths a path.

    Rule: Nav2's plugins/action/smooth_path_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/SmoothPath"
    ACTION_NAME = "smooth_path"
    INPUT_PORTS = {
        "unsmoothed_path": Port(description="The path."),
        "max_smoothing_duration": Port(float, default=3.0, description="The longest time for it, in s."),
        "check_for_collisions": Port(
            bool, default=False, description="Whether the smoothed path is checked for collisions."
        ),
        "smoother_id": Port(str, description="The smoother."),
        "server_name": Port(str, description="Name of the action; smooth_path if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "smoothed_path": Port(description="The smoothed path."),
        "smoothing_duration": Port(float, description="The time that it took, in s."),
        "was_completed": Port(bool, description="Whether the smoothing was completed."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.path = self.read("unsmoothed_path")
        if self.is_given("smoother_id"):
            goal.smoother_id = str(self.read("smoother_id"))
        goal.max_smoothing_duration = duration(self.read("max_smoothing_duration"))
        goal.check_for_collisions = bool(self.read("check_for_collisions"))

    def on_result(self, result: Any) -> Status:
        took = result.smoothing_duration
        give(self, "smoothed_path", result.path)
        give(self, "smoothing_duration", took.sec + took.nanosec * 1e-9)
        give(self, "was_completed", result.was_completed)
        return super().on_result(result)
