"""Wrong values in ROS messages are found in a source only where they are sure."""

from __future__ import annotations

import pytest

from translator.message_fields import wrong_fields

HEAD = """
import numpy as np
from geometry_msgs.msg import Point, Twist, Vector3
import std_msgs.msg
from sensor_msgs.msg import LaserScan
from tree_gardener.ports import get_input
SPEED = 1
COUNT = 0
def count():
    global COUNT
    COUNT = 1.0
def update(self, given, other):
    twist = Twist()
"""
X = "geometry_msgs/Vector3.x"
PORTS = {"number": "int", "text": "string", "real": "double"}


def found(*lines: str) -> list[tuple[int, str, str, str]]:
    source = HEAD + "".join(f"    {line}\n" for line in lines)
    first = HEAD.count("\n") + 1
    wrong = wrong_fields(source, "actions/A.py", PORTS)
    return [(one.line - first, one.field, one.given, one.remedy) for one in wrong]


@pytest.mark.parametrize(
    ("line", "field", "given", "remedy"),
    [
        ("twist.linear.x = 1", "geometry_msgs/Vector3.x", "1", "1.0"),
        ("twist.angular.z = -2", "geometry_msgs/Vector3.z", "-2, of type int", "-2.0"),
        ("twist.linear.x = '1'", "geometry_msgs/Vector3.x", "'1'", "float(…)"),
        ("twist.linear.x = None", "geometry_msgs/Vector3.x", "None", "float(…)"),
        ("twist.linear.x = True", "geometry_msgs/Vector3.x", "True", "float(…)"),
        ("twist.linear.x = SPEED", "geometry_msgs/Vector3.x", "SPEED, of type int", "float(…)"),
        ("twist.linear.x = 2 * SPEED", "geometry_msgs/Vector3.x", "2 * SPEED, of type int", "float(…)"),
        ("twist.linear.x = 0.5 if given else 0", "geometry_msgs/Vector3.x", "0", "0.0"),
        ("twist.linear.x = np.float32(1)", X, "np.float32(1), of type numpy.float32", "float(…)"),
        ("twist.linear.x = round(given)", "geometry_msgs/Vector3.x", "round(given), of type int", "float(…)"),
        ("twist.linear.x = get_input(0, 'number')", X, "get_input(0, 'number'), of type int", "float(…)"),
        ("twist.linear.x = get_input(self, 'text')", X, "get_input(self, 'text'), of type str", "float(…)"),
        ("twist.linear = Point()", "geometry_msgs/Twist.linear", "geometry_msgs/Point", "Vector3(…)"),
        ("Vector3(x=1)", "geometry_msgs/Vector3.x", "1", "1.0"),
        ("Twist(linear=Vector3(y=3))", "geometry_msgs/Vector3.y", "3", "3.0"),
        ("std_msgs.msg.Bool(data=2)", "std_msgs/Bool.data", "2", "True"),
        ("std_msgs.msg.Int32(data=1.0)", "std_msgs/Int32.data", "1.0", "1"),
        ("std_msgs.msg.String(data=5)", "std_msgs/String.data", "5", "str(…)"),
        ("LaserScan(ranges=5)", "sensor_msgs/LaserScan.ranges", "5", "[…]"),
        ("Twist(lineer=Vector3())", "geometry_msgs/Twist.lineer", "linear, angular", ""),
        ("twist.speed = 1.0", "geometry_msgs/Twist.speed", "linear, angular", ""),
    ],
)  # fmt: skip
def test_what_is_sure_is_found(line: str, field: str, given: str, remedy: str) -> None:
    assert found(line) == [(0, field, given, remedy)]


@pytest.mark.parametrize(
    "line",
    [
        "twist.linear.x = 1.0",
        "twist.linear.x = given",
        "twist.linear.x = get_input(self, 'real')",
        "twist.linear.x = get_input(self, 'other')",
        "twist.linear.x = float(1)",
        "twist.linear.x = 1 / 2",
        "twist.linear.x = 1 * given",
        "twist.linear.x = COUNT",
        "twist.linear.x += 1",
        "twist.linear = Vector3(x=1.0)",
        "given.linear.x = 1",
        "Twist(**given)",
        "Twist(check_fields=False)",
        "std_msgs.msg.Int32(data=True)",
        "LaserScan(ranges=[1, 2])",
        "twist = given; twist.linear.x = 1",
        "self.publisher.publish(twist)",
        "twist.linear.x = max(0, given)",
        "std_msgs.msg.Header(stamp=given.now().to_msg())",
    ],
)
def test_what_may_be_right_is_not(line: str) -> None:
    assert found(line) == []


def test_a_source_that_cannot_be_read_or_has_no_messages_has_nothing() -> None:
    assert wrong_fields("from a.msg import (", "a.py") == []
    assert wrong_fields("x = 1", "a.py") == []
