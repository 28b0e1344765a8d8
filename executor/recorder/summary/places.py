"""Where the bodies of a recorded world are, seen from above. Pure."""

from __future__ import annotations

import math
import struct
from typing import Final

import msgspec

from executor.messages import Poses
from executor.stream.pose_codec import POSE_BYTES, unpack

__all__ = ["Places"]

MOST_BOXES: Final = 300
MOST_TRAIL: Final = 400
FARTHEST_M: Final = 1e4
_ROUND: Final = frozenset({"cylinder", "sphere", "capsule"})


class _Shape(msgspec.Struct):
    shape: str
    size: list[float]
    pose: list[float]


class _Object(msgspec.Struct):
    id: int
    kind: str
    shapes: list[_Shape]
    pose: list[float]


class _Scene(msgspec.Struct):
    """The parts of `executor.messages.Scene` that are drawn; meshes are left out."""

    objects: list[_Object]


_decode_scene = msgspec.msgpack.Decoder(_Scene).decode
_decode_poses = msgspec.msgpack.Decoder(Poses).decode


class Places:
    """Follows the frames `scene` and `poses` of a recording."""

    def __init__(self) -> None:
        self._objects: dict[int, _Object] = {}
        self._robot: int | None = None
        self._poses: dict[int, bytes] = {}
        self._trail: list[tuple[float, float]] = []
        self._every, self._seen = 1, 0

    def scene(self, data: bytes) -> None:
        """Takes a world; that of a later segment is the same one.

        Raises:
            ValueError: the bytes are no such frame.
        """
        objects = _decode_scene(data).objects
        self._objects = {each.id: each for each in objects}
        self._robot = next((each.id for each in objects if each.kind == "robot"), None)

    def poses(self, data: bytes) -> None:
        """Takes the poses that changed.

        Raises:
            ValueError: the bytes are no such frame.
        """
        frame = _decode_poses(data)
        count = len(frame.ids) // 2
        if len(frame.ids) != 2 * count or len(frame.poses) != POSE_BYTES * count:
            raise ValueError("the poses of a frame are not as many as its ids")
        for place, number in enumerate(struct.unpack(f"<{count}H", frame.ids)):
            record = frame.poses[place * POSE_BYTES : (place + 1) * POSE_BYTES]
            if number in self._objects:
                self._poses[number] = record
            if number == self._robot:
                self._step(record)

    def trail(self) -> list[list[float]]:
        """Returns the way of the robot as points in m."""
        return [[round(x, 3), round(y, 3)] for x, y in self._trail]

    def boxes(self) -> list[list[float]]:
        """Returns the bodies but the robot as rows [x, y, half length, half width, angle, is round], in m."""
        found: list[list[float]] = []
        for each in self._objects.values():
            if each.kind == "robot":
                continue
            pose = unpack(self._poses[each.id]) if each.id in self._poses else tuple(each.pose)
            for shape in each.shapes:
                row = _box(shape, pose)
                if row is not None:
                    found.append(row)
        return found[:MOST_BOXES]

    def _step(self, record: bytes) -> None:
        """Adds a point to the trail; once there are many, every other one goes."""
        self._seen += 1
        if self._seen % self._every:
            return
        x, y, *_ = unpack(record)
        self._trail.append((x, y))
        if len(self._trail) >= MOST_TRAIL:
            self._trail = self._trail[::2]
            self._every *= 2


def _box(shape: _Shape, pose: tuple[float, ...]) -> list[float] | None:
    size = shape.size
    if len(pose) != 7 or len(shape.pose) != 7 or not size or shape.shape in {"plane", "mesh"}:
        return None
    is_round = shape.shape in _ROUND
    half = (size[0], size[0]) if is_round else (size[0] / 2, size[min(1, len(size) - 1)] / 2)
    turn = _yaw(pose)
    x = pose[0] + math.cos(turn) * shape.pose[0] - math.sin(turn) * shape.pose[1]
    y = pose[1] + math.sin(turn) * shape.pose[0] + math.cos(turn) * shape.pose[1]
    row = [x, y, *half, turn + _yaw(tuple(shape.pose)), float(is_round)]
    if not all(math.isfinite(value) and abs(value) < FARTHEST_M for value in row):
        return None
    return [round(value, 3) for value in row]


def _yaw(pose: tuple[float, ...]) -> float:
    _, _, _, x, y, z, w = pose
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
