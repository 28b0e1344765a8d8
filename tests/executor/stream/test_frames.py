"""A newer frame in place of one that waits."""

from __future__ import annotations

import struct

import msgspec

from executor.messages import Poses
from executor.stream.frames import supersede
from executor.stream.pose_codec import POSE_BYTES


def poses(t: float, **where: int) -> bytes:
    ids = [int(name[1:]) for name in where]
    data = b"".join(bytes([value]) * POSE_BYTES for value in where.values())
    return msgspec.msgpack.encode(Poses(t=t, ids=struct.pack(f"<{len(ids)}H", *ids), poses=data))


def test_poses_are_merged_and_the_newer_one_of_a_body_counts() -> None:
    merged = msgspec.msgpack.decode(supersede(poses(1.0, b1=1, b2=2), poses(2.0, b2=3, b7=4)), type=Poses)
    assert merged.t == 2.0
    assert struct.unpack("<3H", merged.ids) == (1, 2, 7)
    assert [merged.poses[i * POSE_BYTES] for i in range(3)] == [1, 3, 4]


def test_a_picture_replaces_the_older_one_and_nonsense_does_no_harm() -> None:
    assert supersede(b"old", b"new") == b"new"
    broken = poses(1.0, b1=1)[:-3]
    assert supersede(broken, poses(2.0, b1=2)) == poses(2.0, b1=2)
