"""GetCurrentPose of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.reading import give
from tree_gardener.ports import Port


class GetCurrentPose(Behaviour):
    """Writes the robot's pose in the global frame. It fails while the pose is not known.

    Rule: Nav2's plugins/action/get_current_pose_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {
        "robot_base_frame": Port(str, description="Frame of the robot; base_link without a parameter."),
        "global_frame": Port(str, description="Reference frame; map if there is no parameter global_frame."),
    }
    OUTPUT_PORTS = {"current_pose": Port(description="The pose.")}

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))

    def update(self) -> Status:
        pose = self.frames.robot_pose()
        if pose is None:
            return Status.FAILURE
        give(self, "current_pose", pose)
        return Status.SUCCESS
