"""Measurements as ROS messages."""

from __future__ import annotations

import pytest

from executor.ros.messages import clock, joint_state, to_time, transform


def test_a_time_has_seconds_and_nanoseconds() -> None:
    stamp = to_time(2.5)
    assert (stamp.sec, stamp.nanosec) == (2, 500_000_000)
    assert clock(2.5).clock == stamp


def test_a_pose_becomes_a_transform_between_its_frames() -> None:
    made = transform("map", "base", (1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0), 1.0)
    assert (made.header.frame_id, made.child_frame_id) == ("map", "base")
    assert made.transform.translation.y == 2.0
    assert made.transform.rotation.w == 1.0


def test_joints_keep_their_order() -> None:
    made = joint_state({"a": (1.0, 2.0), "b": (3.0, 4.0)}, 1.0)
    assert list(made.name) == ["a", "b"]
    assert list(made.position) == pytest.approx([1, 3])
    assert list(made.velocity) == pytest.approx([2, 4])
