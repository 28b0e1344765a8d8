"""Transforms as plain rows, and as `tf2_msgs/TFMessage` in CDR without a message of ROS.

Where only a recording takes `/tf`, so it costs a fifth of what building the messages does.
"""

from __future__ import annotations

import functools
import struct
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

    from executor.world.geometry.transforms import Pose

__all__ = ["TF_TYPE", "Row", "encode_transforms"]

TF_TYPE: Final = "tf2_msgs/msg/TFMessage"
Row = tuple[str, str, "Pose"]
"""The frames `parent` and `child`, and the pose of the child in the parent."""
_HEAD: Final = struct.Struct("<4sI")
_STAMP: Final = struct.Struct("<iI")
_POSE: Final = struct.Struct("<7d")
_LITTLE_ENDIAN: Final = b"\x00\x01\x00\x00"


def encode_transforms(rows: Sequence[Row], time_s: float) -> bytes:
    """Returns a message with all rows at one time, as CDR with zeros in its gaps."""
    stamp = _STAMP.pack(*divmod(round(time_s * 1e9), 1_000_000_000))
    data = bytearray(_HEAD.pack(_LITTLE_ENDIAN, len(rows)))
    for parent, child, pose in rows:
        data += stamp
        data += _text(parent)
        data += _text(child)
        data += bytes(-(len(data) - len(_LITTLE_ENDIAN)) % 8)
        data += _POSE.pack(*pose)
    return bytes(data)


@functools.cache
def _text(text: str) -> bytes:
    """Returns a text that begins at a multiple of 4, with the gap that leads to the next one."""
    coded = text.encode() + b"\0"
    return struct.pack("<I", len(coded)) + coded + bytes(-len(coded) % 4)
