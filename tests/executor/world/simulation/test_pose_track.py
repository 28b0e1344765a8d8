"""Poses for a recording are those of the stream, packed for several moments at once."""

from __future__ import annotations

import msgspec
import numpy as np

from executor.messages import Poses
from executor.stream.pose_codec import POSE_BYTES, pack, unpack
from executor.world.simulation.pose_track import MOVED_M, POSES_HZ, PoseTrack


def poses_of(*places):
    return np.array([[x, 0, 0, 0, 0, 0, 1] for x in places], np.float32)


def at(*places):
    return lambda: poses_of(*places)


def taken(track):
    frames = [(t, msgspec.msgpack.decode(data, type=Poses)) for t, data in track.take()]
    assert [frame.t for _, frame in frames] == [t for t, _ in frames]
    return [(t, np.frombuffer(frame.ids, "<u2").tolist(), frame.poses) for t, frame in frames]


def test_at_first_all_are_noted_and_then_those_that_changed():
    track = PoseTrack()
    assert track.take() == []
    track.note(0.0, at(0, 1, 2))
    track.note(0.1, at(0, 1, 2))
    track.note(0.2, at(0, 5, 2))
    track.note(0.3, at(7, 5, 9))
    assert taken(track) == [
        (0.0, [0, 1, 2], pack(poses_of(0, 1, 2))),
        (0.2, [1], pack(poses_of(5))),
        (0.3, [0, 2], pack(poses_of(7, 9))),
    ]
    assert track.take() == []


def test_a_slow_body_is_not_lost():
    track = PoseTrack()
    for step in range(101):
        track.note(step / 30, at(step * MOVED_M / 10))
    frames = taken(track)
    assert 2 < len(frames) < 15
    assert abs(unpack(frames[-1][2][:POSE_BYTES])[0] - 100 * MOVED_M / 10) <= 2 * MOVED_M


def test_poses_are_computed_when_they_are_taken():
    track, count = PoseTrack(), []

    def compute():
        count.append(1)
        return poses_of(1)

    track.note(0.0, compute)
    track.note(0.1, compute)
    assert count == []
    assert taken(track) == [(0.0, [0], pack(poses_of(1)))]
    assert len(count) == 2


def test_the_rate_is_kept_in_the_long_run():
    track = PoseTrack()
    count = 0
    for step in range(601):
        if step / 60 >= track.next_s:
            track.note(step / 60, at(step))
            count += 1
    assert abs(count - 10 * POSES_HZ) <= 2
