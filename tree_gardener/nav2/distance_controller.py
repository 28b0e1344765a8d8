"""DistanceController of Nav2."""

from typing import Any

from tree_gardener import DecoratorNode, Port, Status
from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.geometry import distance
from tree_gardener.nav2.reading import input_or


class DistanceController(DecoratorNode):
    """Ticks its child when it starts, and then each time that the robot has moved by `distance`.

    In between it is RUNNING; a child that is RUNNING is ticked at every tick. The distance is measured in a
    straight line from the start, and later from the place of the child's last success. It fails while the
    robot's pose is not known. Rule: Nav2's plugins/decorator/distance_controller.cpp.
    """

    INPUT_PORTS = {
        "distance": Port(float, default=1.0, description="How far the robot moves between two ticks, in m."),
        "global_frame": Port(str, description="Reference frame; map if there is no parameter global_frame."),
        "robot_base_frame": Port(str, description="Frame of the robot; base_link without a parameter."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.frames = Frames(self, kwargs.get("node"))
        self.distance = input_or(self, "distance", 1.0)
        self.start: Any = None
        self.is_first = False

    def update(self) -> Status:
        if self.status is Status.IDLE:
            self.start = self.frames.robot_pose()
            if self.start is None:
                return Status.FAILURE
            self.is_first = True
        self.mark_running()
        pose = self.frames.robot_pose()
        if pose is None:
            return Status.FAILURE
        is_far = distance(self.start, pose) >= self.distance
        if not (self.is_first or is_far or self.child_status() is Status.RUNNING):
            return Status.RUNNING
        self.is_first = False
        status = self.tick_child()
        if status is Status.SUCCESS:
            self.start = pose
        return status
