"""IsGoalNearby of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.geometry import distance, first_beyond, nearest, path_length
from tree_gardener.nav2.reading import input_or
from tree_gardener.ports import Port


class IsGoalNearby(Behaviour):
    """Succeeds if the rest of the path, from the pose nearest to the robot, is shorter than the threshold.

    With a `max_robot_pose_search_dist` of 0 or more, the search for the nearest pose begins where the last
    search in the same path ended, and covers only this distance. It fails while the path is empty or the
    robot's pose is not known. Rule: Nav2's plugins/condition/is_goal_nearby_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "path": Port(description="The path."),
        "proximity_threshold": Port(float, default=1.0, description="The length that counts as near, in m."),
        "max_robot_pose_search_dist": Port(
            float,
            default=-1.0,
            description="How far ahead along the path is searched, in m; -1 is everything.",
        ),
        "global_frame": Port(str, description="Reference frame; map if there is no parameter global_frame."),
        "robot_base_frame": Port(str, description="Frame of the robot; base_link without a parameter."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))
        self.path: Any = None
        self.begin = 0

    def update(self) -> Status:
        path = input_or(self, "path", None)
        if path is None or not path.poses:
            return Status.FAILURE
        ahead = input_or(self, "max_robot_pose_search_dist", -1.0)
        if ahead < 0.0 or path != self.path:
            self.path, self.begin = path, 0
        pose = self.frames.robot_pose()
        pose = None if pose is None else self.frames.transformed(pose, path.header.frame_id)
        if pose is None:
            return Status.FAILURE
        poses = path.poses
        end = len(poses) if ahead < 0.0 else first_beyond(poses, self.begin, ahead)
        self.begin = nearest(self.begin, end, lambda index: distance(pose, poses[index]))
        is_near = path_length(poses, self.begin) < input_or(self, "proximity_threshold", 0.0)
        return Status.SUCCESS if is_near else Status.FAILURE
