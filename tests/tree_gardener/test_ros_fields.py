"""Wrong values in the fields of ROS messages are errors that say what to write."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import Any

import numpy as np
import pytest
from builtin_interfaces.msg import Time as TimeMessage
from geometry_msgs.msg import Point, PoseWithCovariance, Twist, Vector3
from rclpy.time import Time
from sensor_msgs.msg import Image, JointState, LaserScan
from std_msgs.msg import Bool, Byte, Float32, Header, Int8, Int32, String

from tree_gardener.errors import describe
from tree_gardener.ros_fields import check_fields, field_problem, users_frames


@pytest.fixture(autouse=True)
def _on() -> None:
    check_fields()


def problem(kind: Any, field: str, value: Any) -> str:
    message = kind()
    with pytest.raises(AssertionError) as raised:
        setattr(message, field, value)
    return field_problem(raised.value)


FLOAT = "geometry_msgs/Vector3.x takes a float, not "


@pytest.mark.parametrize(
    ("kind", "field", "value", "sentence"),
    [
        (Vector3, "x", 1, f"{FLOAT}the int 1: write 1.0"),
        (Vector3, "x", True, f"{FLOAT}the bool True: write float(…)"),
        (Vector3, "x", "1", f"{FLOAT}the str '1': write float(…)"),
        (Vector3, "x", None, f"{FLOAT}None: give it a value"),
        (Vector3, "x", np.float32(1), f"{FLOAT}the float32 np.float32(1.0): write float(…)"),
        (Vector3, "x", np.int64(1), f"{FLOAT}the int64 np.int64(1): write float(…)"),
        (Vector3, "x", 10**400, f"{FLOAT}the int int of 1329 bits: write float(…)"),
        (Float32, "data", 1e300, "std_msgs/Float32.data takes a float, not the float 1e+300: it must fit"),
        (Bool, "data", 2, "std_msgs/Bool.data takes True or False, not the int 2: write True"),
        (Bool, "data", np.bool_(True), "not the bool np.True_: write bool(…)"),
        (Int32, "data", 2**40, "an int from -2147483648 to 2147483647, not the int 1099511627776"),
        (Int32, "data", 1.0, "not the float 1.0: write 1"),
        (Int32, "data", np.int64(1), "not the int64 np.int64(1): write int(…)"),
        (Int8, "data", 200, "std_msgs/Int8.data takes an int from -128 to 127, not the int 200"),
        (String, "data", 5, "std_msgs/String.data takes a str, not the int 5: write '5'"),
        (String, "data", b"a", "write ….decode()"),
        (Byte, "data", 1, "takes one byte, not the int 1: write bytes([…])"),
        (Header, "stamp", Time(), "takes a message builtin_interfaces/Time, not the Time Time(nanosec"),
        (Header, "stamp", Time(), "write ….to_msg()"),
        (Twist, "linear", Point(), "make one with Vector3(…) of geometry_msgs.msg"),
        (LaserScan, "ranges", [1, 2], "takes a list of float, not the list [1, 2]: write [float(each)"),
        (LaserScan, "ranges", np.zeros(3), "write ….astype(float).tolist()"),
        (Image, "data", [300], "takes a list of uint8, not the list [300]: write [int(each)"),
        (PoseWithCovariance, "covariance", [0.0] * 35, "takes 36 values of double, not the list"),
        (JointState, "name", ["a", 1], "write [str(each) for each in …]"),
    ],
)
def test_each_kind_of_field_says_what_it_takes(kind: Any, field: str, value: Any, sentence: str) -> None:
    assert sentence in problem(kind, field, value)


def test_right_values_are_taken() -> None:
    message = Vector3(x=np.float64(1.5), y=5e-324)
    message.z = float("nan")
    assert (message.x, message.y) == (1.5, 5e-324)
    assert Header(stamp=TimeMessage(sec=1)).stamp.sec == 1
    assert list(LaserScan(ranges=[1, 2]).ranges) == [1.0, 2.0]


def test_a_misspelt_name_is_an_error_with_the_right_one() -> None:
    with pytest.raises(AssertionError) as raised:
        Twist(lineer=Vector3())
    assert describe(raised.value) == "geometry_msgs/Twist has no field 'lineer': write linear"
    with pytest.raises(AssertionError) as raised:
        Twist(speed=1.0)
    assert "it has linear, angular" in describe(raised.value)


def test_the_place_is_the_users_line_and_other_assertions_stay() -> None:
    with pytest.raises(AssertionError) as raised:
        Twist(linear=Vector3(x=1))
    assert {file for file, _ in users_frames(raised.value.__traceback__)} == {__file__}
    with pytest.raises(AssertionError) as raised:
        assert 1 == 2, "no field"  # noqa: PLR0133 - an assertion of a user
    assert field_problem(raised.value) == ""
    assert "no field" in describe(raised.value)


PROGRAM = """
import {early}
from tree_gardener.ros_fields import check_fields
check_fields()
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool
for wrong in (lambda: setattr(Twist().linear, "x", 1), lambda: Twist(x=1), lambda: Bool(data=2)):
    try:
        wrong()
    except AssertionError:
        continue
    print("taken")
print("done")
"""


@pytest.mark.parametrize("early", ["sys", "geometry_msgs.msg, std_msgs.msg"])
@pytest.mark.parametrize(("variable", "taken"), [(None, 0), ("", 0), ("0", 3)])
def test_it_holds_for_classes_that_were_loaded_before(early: str, variable: str | None, taken: int) -> None:
    environment = {**os.environ, "ROS_PYTHON_CHECK_FIELDS": variable or ""}
    if variable is None:
        del environment["ROS_PYTHON_CHECK_FIELDS"]
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM.format(early=early)],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.split() == ["taken"] * taken + ["done"]
