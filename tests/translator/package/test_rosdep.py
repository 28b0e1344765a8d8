"""The rosdep keys of imports."""

from __future__ import annotations

from translator import inspect_action
from translator.package.rosdep import dependencies, rosdep_table


def test_a_key_is_found_by_the_longest_beginning() -> None:
    table = rosdep_table()
    assert table.key_of("cv2") == "python3-opencv"
    assert table.key_of("google.protobuf.message") == "python3-protobuf"
    assert table.key_of("sensor_msgs.msg") == "sensor_msgs"
    assert table.key_of("no_such_module") is None


def test_what_an_action_imports_is_needed_and_what_nobody_knows_is_reported_once() -> None:
    source = "import json, numpy, nothing_known\nimport nothing_known.more\nimport helper\n"
    model = inspect_action(source + "class Go: pass\n", "actions/Go.py")
    keys, found = dependencies([model], {"helper"})
    assert keys == ["python3-numpy"]
    assert [item.values["module"] for item in found] == ["nothing_known"]
