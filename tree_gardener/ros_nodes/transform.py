"""Transforms between frames as a node."""

import math
from typing import Any

from tree_gardener.ros_nodes.frames import Transform, frames_of
from tree_gardener.ros_nodes.leaf import RosLeaf
from tree_gardener.status import Status


class TfLookup(RosLeaf):
    """Finds where a frame is in another frame; RUNNING until it is known, at most for a timeout."""

    _began_s = 0.0

    def setup(self, **kwargs: Any) -> None:
        """Subscribes to ``/tf``."""
        super().setup(**kwargs)
        if self.ros is not None:
            frames_of(self.ros)

    def initialise(self) -> None:
        """Begins to wait."""
        self._began_s = self.now()

    def update(self) -> Status:
        """Looks the transform up."""
        target, source = self.text("target_frame", ""), self.text("source_frame", "")
        found = frames_of(self.joined()).lookup(target, source)
        if found is not None and self._is_recent(found):
            self._give(found, target, source)
            return Status.SUCCESS
        patience_s = self.seconds("timeout", 1000)
        if patience_s < 0 or self.now() - self._began_s < patience_s:
            return Status.RUNNING
        self.give("error", self._reason(target, source, found))
        return Status.FAILURE

    def _is_recent(self, found: Transform) -> bool:
        limit_s = self.seconds("max_age", -1)
        return limit_s < 0 or self._age_s(found) <= limit_s

    def _age_s(self, found: Transform) -> float:
        return float(self.joined().get_clock().now().nanoseconds) * 1e-9 - found.stamp_s

    def _give(self, found: Transform, target: str, source: str) -> None:
        x, y, z = found.translation
        qx, qy, qz, qw = found.rotation
        for port, value in (("x", x), ("y", y), ("z", z)):
            self.give(port, value)
        self.give("yaw", math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz)))
        self.give("error", "")
        if self.literal("pose") is None and "pose" in self._ports():
            self.give("pose", _pose(found, target))

    def _ports(self) -> Any:
        return self.tree_gardener_node.ports

    def _reason(self, target: str, source: str, found: Transform | None) -> str:
        if found is not None:
            return f"the transform from {source} to {target} is {self._age_s(found):.2f} s old"
        missing = [frame for frame in (target, source) if not frames_of(self.joined()).has(frame)]
        if missing:
            return f"the frame {missing[0]} was never named on /tf"
        return f"no transform connects {source} with {target}"


def _pose(found: Transform, frame: str) -> Any:
    """Returns the transform as a PoseStamped in the target frame."""
    from geometry_msgs.msg import PoseStamped  # noqa: PLC0415 - only where ROS is

    pose = PoseStamped()
    pose.header.frame_id = frame
    if math.isfinite(found.stamp_s):
        pose.header.stamp.sec = math.floor(found.stamp_s)
        pose.header.stamp.nanosec = min(999_999_999, round(found.stamp_s % 1.0 * 1e9))
    place, turn = pose.pose.position, pose.pose.orientation
    place.x, place.y, place.z = found.translation
    turn.x, turn.y, turn.z, turn.w = found.rotation
    return pose
