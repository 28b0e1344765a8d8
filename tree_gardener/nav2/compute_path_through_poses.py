"""ComputePathThroughPoses of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Action
from tree_gardener.nav2.poses import pose_from, poses_from
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port


class ComputePathThroughPoses(Nav2Action):
    """Computes a path over poses.

    Rule: Nav2's plugins/action/compute_path_through_poses_action.cpp.
    """

    ACTION_TYPE = "nav2_msgs/action/ComputePathThroughPoses"
    ACTION_NAME = "compute_path_through_poses"
    INPUT_PORTS = {
        "start": Port(description="The start; without it the robot's pose."),
        "goals": Port(description="The goals; as a text, x;y;yaw with | between them."),
        "planner_id": Port(str, default="", description="The planner."),
        "server_name": Port(
            str, description="Name of the action; compute_path_through_poses if it is not given."
        ),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
    OUTPUT_PORTS = {
        "path": Port(description="The path; an empty one after an error."),
        "last_reached_index": Port(int, description="The index of the last goal that the path reaches."),
        "error_code_id": Port(int, description="The error code of Nav2; 0 after a success."),
        "error_msg": Port(str, description="The reason, if it failed."),
    }

    def set_goal(self, goal: Any) -> None:
        poses = poses_from(self.read("goals"))
        if hasattr(goal.goals, "goals"):
            goal.goals.goals = poses
        else:
            goal.goals = poses
        goal.planner_id = str(self.read("planner_id"))
        if self.is_given("start"):
            goal.start, goal.use_start = pose_from(self.read("start")), True

    def give_result(self, result: Any) -> None:
        result = self._type.Result() if result is None else result
        give(self, "path", result.path)
        give(self, "last_reached_index", getattr(result, "last_reached_index", -1))
