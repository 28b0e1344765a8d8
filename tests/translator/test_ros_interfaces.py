"""The interfaces that blocks may use, with and without ROS."""

from __future__ import annotations

import subprocess
import sys

import pytest

from translator.ros_interfaces import (
    full_name,
    has_package,
    interface_fields,
    interface_names,
    port_type,
)


def test_installed_interfaces_are_listed_with_their_kind() -> None:
    names = dict(interface_names())
    assert names["geometry_msgs/msg/Twist"] == "msg"
    assert names["std_srvs/srv/Trigger"] == "srv"
    assert names["nav2_msgs/action/NavigateToPose"] == "action"
    assert not any("_" in name.rpartition("/")[2] for name in names), "parts of actions are not listed"


def test_the_fields_of_an_action_are_ports() -> None:
    fields = {each.port: each for each in interface_fields("nav2_msgs/action/NavigateToPose") or ()}
    assert fields["goal__pose__pose__position__x"].type == "double"
    assert fields["goal__pose__pose__orientation__yaw"].direction == "input"
    assert fields["goal__pose"].type == "any"
    assert fields["result__error_code"].direction == "output"
    assert fields["feedback__distance_remaining"].direction == "output"
    assert fields["result__error_code"].model.description == "result.error_code, uint16."


@pytest.mark.parametrize(("is_received", "direction"), [(False, "input"), (True, "output")])
def test_a_message_is_written_or_read(is_received: bool, direction: str) -> None:
    fields = interface_fields("sensor_msgs/msg/LaserScan", is_received=is_received) or ()
    ranges = next(each for each in fields if each.port == "message__ranges")
    assert (ranges.type, ranges.direction) == ("list[double]", direction)


def test_an_interface_that_is_not_here_has_no_fields() -> None:
    assert interface_fields("no_msgs/msg/Nothing") is None
    assert not has_package("no_msgs/msg/Nothing")
    assert has_package("geometry_msgs/msg/Nothing")


@pytest.mark.parametrize(
    ("name", "full"),
    [
        ("std_srvs/Trigger", "std_srvs/srv/Trigger"),
        (" std_srvs/srv/Trigger ", "std_srvs/srv/Trigger"),
        ("std_srvs/msg/Trigger", None),
        ("Trigger", None),
        ("../etc/srv/Passwd", None),
    ],
)
def test_names_are_completed_or_refused(name: str, full: str | None) -> None:
    assert full_name(name, "srv") == full


def test_types_of_ports() -> None:
    kinds = ("uint8", "string<10>", "sequence<double, 3>", "sequence<uint8>", "geometry_msgs/Point", "int64")
    assert [port_type(each) for each in kinds] == ["uint", "string", "list[double]", "any", "any", "any"]


def test_nothing_of_ros_is_imported() -> None:
    code = (
        "import sys; from translator.ros_interfaces import interface_fields as f;"
        "f('geometry_msgs/msg/Twist'); sys.exit('geometry_msgs' in sys.modules or 'rclpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False, timeout=60).returncode == 0


def test_a_server_without_ros_knows_what_its_sessions_have() -> None:
    code = (
        "import sys; import translator.ros_interfaces as r; sys.path.clear();"
        "fields = {each.port: each.type for each in r.interface_fields('nav2_msgs/action/NavigateToPose')};"
        "names = dict(r.interface_names());"
        "sys.exit(not (r.installed() == {} and fields['goal__pose__pose__orientation__yaw'] == 'double'"
        " and names['std_srvs/srv/Trigger'] == 'srv' and r.has_package('geometry_msgs/msg/Nothing')))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False, timeout=60).returncode == 0
