"""DistanceTraveled of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.geometry import distance
from tree_gardener.nav2.reading import input_or, is_active
from tree_gardener.ports import Port


class DistanceTraveled(Behaviour):
    """Succeeds once each time that the robot has moved by `distance`; in between it fails.

    The distance is measured in a straight line from the start, at which the node fails, and later from the
    place of each success. It fails while the robot's pose is not known. Rule: Nav2's
    plugins/condition/distance_traveled_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "distance": Port(float, default=1.0, description="How far the robot moves, in m."),
        "global_frame": Port(str, description="Reference frame; map if there is no parameter global_frame."),
        "robot_base_frame": Port(str, description="Frame of the robot; base_link without a parameter."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))
        self.distance = 1.0
        self.start: Any = None

    def update(self) -> Status:
        pose = self.frames.robot_pose()
        if not is_active(self):
            self.distance = input_or(self, "distance", self.distance)
            self.start = pose or self.start
            return Status.FAILURE
        if pose is None:
            return Status.FAILURE
        if self.start is None:  # its pose was not known at the start
            self.start = pose
        if distance(self.start, pose) < self.distance:
            return Status.FAILURE
        self.start = pose
        return Status.SUCCESS
