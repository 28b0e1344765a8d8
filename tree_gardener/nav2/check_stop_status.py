"""CheckStopStatus of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or, now
from tree_gardener.nav2.topics import Odometer, stamp_s
from tree_gardener.ports import Port


class CheckStopStatus(Behaviour):
    """Succeeds when the robot has been slower than the threshold for `duration_stopped`; fails when it moves.

    While it is stopped for less, it is RUNNING. A robot without odometry counts as stopped. The time
    continues during halts. Rule: Nav2's plugins/action/check_stop_status_action.cpp.
    """

    NODE_KIND = "Action"
    INPUT_PORTS = {
        "velocity_threshold": Port(float, default=0.01, description="The speed below which it is stopped."),
        "duration_stopped": Port(int, default=1000, description="For how long, in ms."),
    }

    def setup(self, **kwargs: Any) -> None:
        self.odometer = Odometer(kwargs.get("node"))
        self.since_s: float | None = None

    def update(self) -> Status:
        latest, threshold = self.odometer.latest, input_or(self, "velocity_threshold", 0.01)
        if latest is not None and not is_slow(latest.twist.twist, threshold):
            self.since_s = None
            return Status.FAILURE
        if self.since_s is None:
            self.since_s = (latest is not None and stamp_s(latest.header.stamp)) or now(self)
        if now(self) - self.since_s <= input_or(self, "duration_stopped", 1000) / 1000.0:
            return Status.RUNNING
        self.since_s = None
        return Status.SUCCESS

    def shutdown(self) -> None:
        self.odometer.close()


def is_slow(twist: Any, threshold: float) -> bool:
    """Returns whether a velocity is below the threshold, along both axes and in turning."""
    return all(abs(speed) < threshold for speed in (twist.linear.x, twist.linear.y, twist.angular.z))
