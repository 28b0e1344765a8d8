"""TruncatePathLocal of Nav2."""

import math
from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.geometry import copied, distance, first_beyond, nearest, turn_between
from tree_gardener.nav2.reading import give, input_or
from tree_gardener.ports import Port


class TruncatePathLocal(Behaviour):
    """Writes the part of the path around the robot, up to the given distances ahead and behind.

    The robot is at the pose of the path that is nearest to `pose`, or to the pose by tf;
    `angular_distance_weight` is the weight of a turn in metres per radian. A negative `distance_forward`
    means to the end. With a finite `max_robot_pose_search_dist` the search begins where the last search in
    the same path ended, and covers only this distance. It fails while the robot's pose is not known. Rule:
    Nav2's plugins/action/truncate_path_local_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "input_path": Port(description="The path."),
        "distance_forward": Port(float, default=8.0, description="How far ahead, in m; -1 is to the end."),
        "distance_backward": Port(float, default=4.0, description="How far behind, in m."),
        "robot_base_frame": Port(str, description="Frame of the robot; base_link without a parameter."),
        "transform_tolerance": Port(float, default=0.2, description="Not used: a tick does not wait."),
        "pose": Port(description="A pose in place of the robot's."),
        "angular_distance_weight": Port(float, default=0.0, description="What a turn counts, in m a radian."),
        "max_robot_pose_search_dist": Port(
            float, default="inf", description="How far ahead along the path is searched, in m."
        ),
    }
    OUTPUT_PORTS = {"output_path": Port(description="The part of the path.")}

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))
        self.path: Any = None
        self.begin = 0

    def update(self) -> Status:
        path = input_or(self, "input_path", None)
        if path is None:
            return Status.FAILURE
        ahead = input_or(self, "max_robot_pose_search_dist", math.inf)
        if not math.isfinite(ahead) or path != self.path:
            self.path, self.begin = path, 0
        pose = input_or(self, "pose", None) or self.frames.robot_pose(path.header.frame_id)
        if pose is None:
            return Status.FAILURE
        give(self, "output_path", self.around(path, pose, ahead) if path.poses else path)
        return Status.SUCCESS

    def around(self, path: Any, pose: Any, ahead: float) -> Any:
        """Returns the part of a path that is around a pose."""
        poses = path.poses
        end = first_beyond(poses, self.begin, ahead) if math.isfinite(ahead) else len(poses)
        weight = input_or(self, "angular_distance_weight", 0.0)

        def far(index: int) -> float:
            turn = turn_between(pose.pose.orientation, poses[index].pose.orientation)
            return math.hypot(distance(pose, poses[index]), weight * turn)

        here = nearest(self.begin, end, far)
        if math.isfinite(ahead):
            self.begin = here
        forward = input_or(self, "distance_forward", 8.0)
        stop = first_beyond(poses, here, math.inf if forward < 0.0 else forward)
        back = poses[here::-1]
        behind = first_beyond(back, 0, input_or(self, "distance_backward", 4.0))
        return copied(path, poses=list(poses[here + 1 - behind : stop]))
