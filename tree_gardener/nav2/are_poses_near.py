"""ArePosesNear of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.geometry import distance
from tree_gardener.nav2.reading import input_or
from tree_gardener.ports import Port


class ArePosesNear(Behaviour):
    """Succeeds if two poses are at most `tolerance` apart in the plane.

    Poses of different frames are compared in the global frame; it fails if they cannot be transformed.
    Rule: Nav2's plugins/condition/are_poses_near_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "ref_pose": Port(description="The first pose."),
        "target_pose": Port(description="The second pose."),
        "global_frame": Port(str, description="Reference frame; map if there is no parameter global_frame."),
        "tolerance": Port(float, default=0.5, description="The largest distance, in m."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))

    def update(self) -> Status:
        first, second = input_or(self, "ref_pose", None), input_or(self, "target_pose", None)
        if first is None or second is None:
            return Status.FAILURE
        if first.header.frame_id != second.header.frame_id:
            frame = self.frames.frame("global_frame")
            first = self.frames.transformed(first, frame)
            second = self.frames.transformed(second, frame)
            if first is None or second is None:
                return Status.FAILURE
        is_near = distance(first, second) <= input_or(self, "tolerance", 0.5)
        return Status.SUCCESS if is_near else Status.FAILURE
