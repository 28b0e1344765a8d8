"""The rosdep keys of imports."""

from __future__ import annotations

import pytest

from translator import inspect_action
from translator.nav2.sources import nav2_source
from translator.package.rosdep import dependencies, rosdep_table


def test_a_key_is_found_by_the_longest_beginning() -> None:
    table = rosdep_table()
    assert table.key_of("cv2") == "python3-opencv"
    assert table.key_of("google.protobuf.message") == "python3-protobuf"
    assert table.key_of("sensor_msgs.msg") == "sensor_msgs"
    assert table.key_of("tf2_ros.buffer") == "tf2_ros_py"
    assert table.key_of("no_such_module") is None


def test_what_an_action_imports_is_needed_and_what_nobody_knows_is_reported_once() -> None:
    source = "import json, numpy, nothing_known\nimport nothing_known.more\nimport helper\n"
    model = inspect_action(source + "class Go: pass\n", "actions/Go.py")
    keys, found = dependencies([model], {"helper"})
    assert keys == ["python3-numpy"]
    assert [item.values["module"] for item in found] == ["nothing_known"]


@pytest.mark.parametrize(
    ("type_", "keys"),
    [
        ("IsBatteryLow", {"sensor_msgs"}),
        ("ControllerSelector", {"std_msgs"}),
        ("GoalReached", {"geometry_msgs", "tf2_geometry_msgs", "tf2_ros_py"}),
        ("Spin", {"geometry_msgs", "nav2_msgs"}),
    ],
)
def test_a_node_of_nav2_needs_the_packages_that_the_engine_imports_for_it(type_: str, keys: set[str]) -> None:
    action = inspect_action(nav2_source(type_) or "", f"actions/{type_}.py")
    found, missing = dependencies([action], set())
    assert set(found) >= keys
    assert not set(found) & {"nav2_msgs", "sensor_msgs", "std_msgs"} - keys
    assert missing == []
