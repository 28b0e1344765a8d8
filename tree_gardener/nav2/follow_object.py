"""FollowObject of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import duration
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port
from tree_gardener.status import Status


class FollowObject(Nav2Action):
    """Follows an object.

    Rule: Nav2's plugins/action/follow_object_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/FollowObject"
    ACTION_NAME = "follow_object"
    INPUT_PORTS = {
        "pose_topic": Port(str, default="dynamic_pose", description="The topic of the object's poses."),
        "max_duration": Port(
            float, default=0.0, description="The longest time for it, in s; 0 is without limit."
        ),
        "tracked_frame": Port(str, description="The frame of the object."),
        "server_name": Port(str, description="Name of the action; follow_object if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "total_elapsed_time": Port(description="The time that it took."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.pose_topic = str(self.read("pose_topic"))
        if self.is_given("tracked_frame"):
            goal.tracked_frame = str(self.read("tracked_frame"))
        goal.max_duration = duration(self.read("max_duration"))

    def give_result(self, result: Any) -> None:
        if result is not None:
            give(self, "total_elapsed_time", result.total_elapsed_time)

    def on_aborted(self, result: Any) -> Status:
        self.give_result(result)
        return super().on_aborted(result)

    def on_cancelled(self, result: Any) -> Status:
        self.give_result(result)
        return super().on_cancelled(result)
