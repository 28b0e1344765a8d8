"""ComputePathToPose of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action, put
from tree_gardener.nav2.poses import pose_from, poses_from
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port


class ComputePathToPose(Nav2Action):
    """Computes a path to a pose.

    Rule: Nav2's plugins/action/compute_path_to_pose_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/ComputePathToPose"
    ACTION_NAME = "compute_path_to_pose"
    INPUT_PORTS = {
        "start": Port(description="The start; without it the robot's pose."),
        "use_start": Port(bool, description="Whether the start is used."),
        "goal": Port(description="The goal; a text is x;y;yaw in the map."),
        "viapoints": Port(description="Poses on the way."),
        "planner_id": Port(str, default="", description="The planner."),
        "server_name": Port(str, description="Name of the action; compute_path_to_pose if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "path": Port(description="The path; an empty one after an error."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        goal.goal = pose_from(self.read("goal"))
        goal.planner_id = str(self.read("planner_id"))
        if self.is_given("start"):
            goal.start = pose_from(self.read("start"))
            goal.use_start = self.read("use_start") if self.is_given("use_start") else True
        if self.is_given("viapoints"):
            put(goal, viapoints=poses_from(self.read("viapoints")))

    def give_result(self, result: Any) -> None:
        give(self, "path", self._type.Result().path if result is None else result.path)
