"""IsStuck of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.topics import Topic, stamp_s


class IsStuck(Behaviour):
    """Succeeds if the robot brakes harder than 10 m/s², which means that it hit something; else it fails.

    The acceleration is that between the last two messages of `odom`, from the third one on.
    Rule: Nav2's plugins/condition/is_stuck_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS: dict[str, Any] = {}

    def setup(self, **kwargs: Any) -> None:
        self.last: Any = None
        self.received = 0
        self.acceleration = 0.0
        self.odometry = Topic(kwargs.get("node"), "nav_msgs", "Odometry")
        self.odometry.follow("odom", self.on_odometry)

    def on_odometry(self, odometry: Any) -> None:
        """Computes the acceleration since the last message."""
        self.received += 1
        if self.received > 2:
            time_s = stamp_s(odometry.header.stamp) - stamp_s(self.last.header.stamp)
            change = odometry.twist.twist.linear.x - self.last.twist.twist.linear.x
            if time_s:
                self.acceleration = change / time_s
        self.last = odometry

    def update(self) -> Status:
        return Status.SUCCESS if self.acceleration < -10.0 else Status.FAILURE

    def shutdown(self) -> None:
        self.odometry.close()
