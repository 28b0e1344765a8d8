"""Poses from ports."""

from __future__ import annotations

import math

import pytest
from geometry_msgs.msg import PoseStamped

from tree_gardener.errors import PortError
from tree_gardener.nav2.poses import duration, pose_from, poses_from


def test_a_short_text_is_a_pose_in_the_map() -> None:
    pose = pose_from(f"1; -2 ;{math.pi / 2}")
    assert (pose.header.frame_id, pose.pose.position.x, pose.pose.position.y) == ("map", 1.0, -2.0)
    assert pose.pose.orientation.z == pytest.approx(math.sqrt(0.5))
    assert pose.pose.orientation.w == pytest.approx(math.sqrt(0.5))


def test_a_text_of_nav2_has_stamp_and_frame() -> None:
    pose = pose_from("1500000000;odom;1;2;3;0;0;0.6;0.8")
    assert (pose.header.stamp.sec, pose.header.stamp.nanosec) == (1, 500_000_000)
    assert (pose.header.frame_id, pose.pose.position.z, pose.pose.orientation.w) == ("odom", 3.0, 0.8)


@pytest.mark.parametrize("text", ["", "1;2", "a;b;c", "x;odom;1;2;3;0;0;0;1"])
def test_another_text_is_an_error_that_says_how_to_write_it(text: str) -> None:
    with pytest.raises(PortError, match="write x;y;yaw"):
        pose_from(text)


def test_lists_come_as_text_list_or_message() -> None:
    class Goals:
        goals = (PoseStamped(),)

    assert [pose.pose.position.x for pose in poses_from("1;0;0| 2;0;0 |")] == [1.0, 2.0]
    assert poses_from([PoseStamped()]) == [PoseStamped()]
    assert poses_from(Goals()) == [PoseStamped()]


@pytest.mark.parametrize(
    ("seconds", "expected"), [(0.0, (0, 0)), (2.5, (2, 500_000_000)), (1.9999999999, (1, 999_999_999))]
)
def test_a_duration_is_whole_seconds_and_nanoseconds(seconds: float, expected: tuple[int, int]) -> None:
    found = duration(seconds)
    assert (found.sec, found.nanosec) == expected
