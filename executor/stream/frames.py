"""Merges a frame with an older frame of the same stream that was not sent yet."""

from __future__ import annotations

import struct
from typing import Final

import msgspec

from executor.messages import Poses
from executor.stream.pose_codec import POSE_BYTES

__all__ = ["supersede"]

_POSES_MARK: Final = b"\xa5poses"
_decode_poses = msgspec.msgpack.Decoder(Poses).decode
_encode = msgspec.msgpack.Encoder().encode


def supersede(waiting: bytes, newer: bytes) -> bytes:
    """Returns one frame that replaces both.

    A picture or a scan replaces the older one. `poses` holds only changes, so dropping one could leave a body
    that has come to rest in the wrong place: poses are merged.
    """
    if not (_looks_like_poses(waiting) and _looks_like_poses(newer)):
        return newer
    try:
        old, new = _decode_poses(waiting), _decode_poses(newer)
    except msgspec.DecodeError:
        return newer
    by_id = _split(old) | _split(new)
    ids = struct.pack(f"<{len(by_id)}H", *by_id)
    return _encode(Poses(t=new.t, ids=ids, poses=b"".join(by_id.values())))


def _looks_like_poses(data: bytes) -> bool:
    return _POSES_MARK in data[:16]


def _split(frame: Poses) -> dict[int, bytes]:
    ids = struct.unpack(f"<{len(frame.ids) // 2}H", frame.ids)
    return {object_id: frame.poses[i * POSE_BYTES : (i + 1) * POSE_BYTES] for i, object_id in enumerate(ids)}
