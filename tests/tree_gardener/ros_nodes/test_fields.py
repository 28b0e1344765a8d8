"""The fields of messages, from texts of ports."""

from __future__ import annotations

import math
from typing import Any

import pytest
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovariance
from sensor_msgs.msg import LaserScan

from tree_gardener import PortError
from tree_gardener.ros_nodes.fields import assign, interface, name_of, path_of, read, type_at


def test_an_interface_is_found_in_both_spellings() -> None:
    assert interface("geometry_msgs/msg/Point", "msg") is interface("geometry_msgs/Point", "msg") is Point
    assert name_of(Point) == "geometry_msgs/Point"


def test_a_path_names_a_field_and_its_type() -> None:
    assert type_at(PoseStamped(), path_of("pose__position__x")) == "double"
    assert type_at(PoseStamped(), ["pose", "orientation", "yaw"]) == "double"
    with pytest.raises(PortError, match="has no fields"):
        type_at(PoseStamped(), ["header", "frame_id", "x"])


@pytest.mark.parametrize(
    ("path", "value", "expected"),
    [
        ("pose__position__x", "1.5", 1.5),
        ("pose__position__x", 2, 2.0),
        ("header__frame_id", "map", "map"),
        ("header__stamp__sec", "-3", -3),
        ("pose__position", 'json:{"y": 2}', Point(y=2.0)),
        ("pose__position", {"y": 2}, Point(y=2.0)),
        ("pose__position", Point(z=1.0), Point(z=1.0)),
    ],
)
def test_a_value_of_a_port_becomes_a_field(path: str, value: Any, expected: Any) -> None:
    message = assign(PoseStamped(), path_of(path), value)
    assert read(message, path_of(path)) == expected


def test_a_heading_is_a_quaternion() -> None:
    pose = assign(PoseStamped(), ["pose", "orientation", "yaw"], "1.0")
    assert pose.pose.orientation.z == pytest.approx(math.sin(0.5))
    assert read(pose, ["pose", "orientation", "yaw"]) == pytest.approx(1.0)


def test_a_time_is_seconds_or_now() -> None:
    pose = assign(PoseStamped(), ["header", "stamp"], "1.25")
    assert (pose.header.stamp.sec, pose.header.stamp.nanosec) == (1, 250_000_000)
    assert assign(PoseStamped(), ["header", "stamp"], "now", 7.5).header.stamp.sec == 7


def test_lists_are_written_with_semicolons() -> None:
    scan = assign(LaserScan(), ["ranges"], "1;2.5")
    assert read(scan, ["ranges"]) == [1.0, 2.5]
    covariance = assign(PoseWithCovariance(), ["covariance"], "json:" + str([0.0] * 36))
    assert read(covariance, ["covariance"]) == [0.0] * 36


def test_a_whole_message_is_replaced() -> None:
    assert assign(Point(), [], Point(x=1.0)).x == 1.0


@pytest.mark.parametrize(
    ("message", "path", "value", "text"),
    [
        (PoseStamped(), "pose__positon", "1", "did you mean position"),
        (PoseStamped(), "pose__position__x", "far", "is a number"),
        (PoseStamped(), "header__stamp__sec", "1.5", "whole number"),
        (PoseStamped(), "header__stamp__nanosec", "-1", "is from 0 to"),
        (PoseStamped(), "pose__position", "here", "give an entry of this type"),
        (PoseStamped(), "pose__position", "json:{", "is not JSON"),
        (PoseWithCovariance(), "covariance", "1;2", "has 36 values"),
        (LaserScan(), "ranges", 5, "write 1;2;3"),
    ],
)
def test_what_does_not_suit_is_explained(message: Any, path: str, value: Any, text: str) -> None:
    with pytest.raises(PortError, match=text):
        assign(message, path_of(path), value)
