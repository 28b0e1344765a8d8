"""Encodes poses for the stream: 16 bytes for each pose, while floats would need 28.

=====  ==============================================================================================
bytes  what
=====  ==============================================================================================
0-8    x, y, z as signed 24-bit integers in units of 0.1 mm (up to 838 m to each side)
9      index of the omitted one of qx, qy, qz, qw: the one with the largest absolute value, 0 to 3
10-15  the other three in their order, as signed 16-bit integers in units of 1/(32767 * sqrt(2))
=====  ==============================================================================================

All little-endian. The sign of the quaternion is chosen so that the omitted value is positive; it follows from
the others, since a quaternion has length 1. Positions are off by at most 0.05 mm, directions by less than
0.0001 rad.
"""

from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

__all__ = ["POSE_BYTES", "pack", "unpack"]

POSE_BYTES: Final = 16
UNITS_PER_M: Final = 10_000
LARGEST: Final = (1 << 23) - 1
TURN_SCALE: Final = 32767 * math.sqrt(2)
_TURN: Final = struct.Struct("<B3h")


def pack(poses: NDArray[np.float32]) -> bytes:
    """Returns rows [x, y, z, qx, qy, qz, qw] as bytes."""
    import numpy as np  # noqa: PLC0415 - the manager reads poses too, and can do without

    count = len(poses)
    packed = np.empty((count, POSE_BYTES), np.uint8)
    units = np.clip(np.rint(poses[:, :3].astype(np.float64) * UNITS_PER_M), -LARGEST, LARGEST)
    packed[:, :9] = units.astype("<i4").view(np.uint8).reshape(count, 3, 4)[:, :, :3].reshape(count, 9)
    turns = poses[:, 3:7].astype(np.float64)
    turns /= np.maximum(np.linalg.norm(turns, axis=1, keepdims=True), 1e-12)
    largest = np.abs(turns).argmax(axis=1)
    rows = np.arange(count)
    turns *= np.where(turns[rows, largest] < 0, -1.0, 1.0)[:, None]
    others = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])[largest]
    packed[:, 9] = largest
    rest = np.clip(np.rint(turns[rows[:, None], others] * TURN_SCALE), -32767, 32767)
    packed[:, 10:] = rest.astype("<i2").view(np.uint8).reshape(count, 6)
    return packed.tobytes()


def unpack(record: bytes | memoryview) -> tuple[float, ...]:
    """Returns one pose [x, y, z, qx, qy, qz, qw].

    Raises:
        ValueError: the record is invalid.
    """
    if len(record) != POSE_BYTES:
        raise ValueError(f"a pose has {POSE_BYTES} bytes, not {len(record)}")
    position = [int.from_bytes(record[i : i + 3], "little", signed=True) / UNITS_PER_M for i in (0, 3, 6)]
    largest, *rest = _TURN.unpack(record[9:])
    if largest > 3:
        raise ValueError(f"a quaternion has no part {largest}")
    turn = [value / TURN_SCALE for value in rest]
    turn.insert(largest, math.sqrt(max(0.0, 1.0 - sum(value * value for value in turn))))
    return (*position, *turn)
