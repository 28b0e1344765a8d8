"""Message definitions."""

from __future__ import annotations

import pytest

from executor.recorder.definitions import DefinitionError, Field, fields_of, full_text, names_of_ours


def test_each_of_our_types_begins_with_its_time():
    names = names_of_ours()
    assert len(names) == 13
    assert {fields_of(name)[0] for name in names} == {
        Field("stamp", "builtin_interfaces/Time", is_list=False)
    }


def test_a_definition_holds_all_types_that_it_uses_once():
    text = full_text("sensor_msgs/msg/LaserScan")
    assert [line for line in text.splitlines() if line.startswith("MSG: ")] == [
        "MSG: std_msgs/Header",
        "MSG: builtin_interfaces/Time",
    ]
    assert "float32[] ranges" in text


def test_constants_are_no_fields():
    assert "STATUS_FIX" not in {field.name for field in fields_of("sensor_msgs/msg/NavSatStatus")}


@pytest.mark.parametrize("name", ["nowhere/msg/Thing", "bt_studio_msgs/msg/Nothing", "../x/msg/a.b"])
def test_a_missing_definition_is_named(name):
    with pytest.raises(DefinitionError, match=r"is not there|is not the name"):
        full_text(name)


def test_packages_that_set_up_builds_are_known():
    assert "MSG: geometry_msgs/TransformStamped" in full_text("tf2_msgs/msg/TFMessage")
    assert [field.name for field in fields_of("vision_msgs/msg/Point2D")] == ["x", "y"]
