"""The frames of ``/tf``: the latest transform between two of them. It needs no ``tf2_ros``."""

import dataclasses
import functools
from collections.abc import Iterator
from typing import Any, Final

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

DEEPEST: Final = 1000


@dataclasses.dataclass(frozen=True)
class Transform:
    """A transform: the pose of a frame in another one, and its time."""

    translation: Vector = (0.0, 0.0, 0.0)
    rotation: Quaternion = (0.0, 0.0, 0.0, 1.0)
    stamp_s: float = float("inf")

    def then(self, other: "Transform") -> "Transform":
        """Returns the transform of a frame that `other` places in this one."""
        x, y, z = rotated(self.rotation, other.translation)
        place = (self.translation[0] + x, self.translation[1] + y, self.translation[2] + z)
        turn = multiplied(self.rotation, other.rotation)
        return Transform(place, turn, min(self.stamp_s, other.stamp_s))

    def inverse(self) -> "Transform":
        """Returns the transform in the other direction."""
        x, y, z, w = self.rotation
        turn = (-x, -y, -z, w)
        place = rotated(turn, self.translation)
        return Transform((-place[0], -place[1], -place[2]), turn, self.stamp_s)


class Frames:
    """The latest transforms of ``/tf`` and ``/tf_static``. All nodes of one ROS node share them."""

    def __init__(self) -> None:
        self._parents: dict[str, tuple[str, Transform]] = {}

    def received(self, message: Any, *, is_fixed: bool = False) -> None:
        """Stores the transforms of a message."""
        for each in message.transforms:
            move, turn = each.transform.translation, each.transform.rotation
            stamp = each.header.stamp
            stamp_s = float("inf") if is_fixed else stamp.sec + stamp.nanosec * 1e-9
            self._parents[_bare(each.child_frame_id)] = (
                _bare(each.header.frame_id),
                Transform((move.x, move.y, move.z), (turn.x, turn.y, turn.z, turn.w), stamp_s),
            )

    def lookup(self, target: str, source: str) -> Transform | None:
        """Returns where the frame `source` is in the frame `target`; None if nothing connects them."""
        above = dict(self._up(_bare(target)))
        for name, from_source in self._up(_bare(source)):
            if name in above:
                return above[name].inverse().then(from_source)
        return None

    def has(self, frame: str) -> bool:
        """Returns whether a frame was ever named."""
        name = _bare(frame)
        return name in self._parents or any(parent == name for parent, _ in self._parents.values())

    def _up(self, frame: str) -> Iterator[tuple[str, Transform]]:
        """Yields a frame and those above it, each with the transform from the frame to it."""
        placed = Transform()
        for _ in range(DEEPEST):
            yield frame, placed
            if frame not in self._parents:
                return
            frame, step = self._parents[frame]
            placed = step.then(placed)


def frames_of(ros: Any) -> Frames:
    """Returns the frames of an rclpy node; subscribes at the first request."""
    frames = getattr(ros, "tree_gardener_frames", None)
    if frames is None:
        from tf2_msgs.msg import TFMessage  # noqa: PLC0415 - only where ROS is

        from tree_gardener.ros_nodes.publish import quality  # noqa: PLC0415 - as above

        # On the rclpy node, so that it lives as long as that does.
        frames = ros.tree_gardener_frames = Frames()
        ros.create_subscription(TFMessage, "/tf", frames.received, quality(sensor=True))
        fixed = functools.partial(frames.received, is_fixed=True)
        ros.create_subscription(TFMessage, "/tf_static", fixed, quality(latched=True))
    found: Frames = frames
    return found


def multiplied(a: Quaternion, b: Quaternion) -> Quaternion:
    """Returns the product of two quaternions."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotated(turn: Quaternion, vector: Vector) -> Vector:
    """Returns a vector turned by a quaternion."""
    x, y, z, w = turn
    product = multiplied(multiplied(turn, (*vector, 0.0)), (-x, -y, -z, w))
    return product[:3]


def _bare(frame: str) -> str:
    return frame.removeprefix("/")
