"""The interfaces that are installed here, read from their files."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from translator.installed_interfaces import installed, installed_fields, part_class, table

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


def test_the_parts_of_an_interface_are_classes() -> None:
    assert part_class("nav2_msgs/action/Wait", "Goal") == "Wait_Goal"
    assert part_class("geometry_msgs/msg/Twist", "") == "Twist"


def test_the_fields_of_a_class_are_read_from_its_file() -> None:
    assert installed_fields("geometry_msgs/msg/Twist", "Twist") == {
        "linear": "geometry_msgs/Vector3",
        "angular": "geometry_msgs/Vector3",
    }
    assert installed_fields("no_msgs/msg/Nothing", "Nothing") is None
    assert installed_fields("std_srvs/srv/Trigger", "Trigger_Request") == {}
    assert set(table()["std_srvs/srv/Trigger"]["Trigger_Response"]) == {"success", "message"}


def test_a_broken_package_of_interfaces_has_no_fields(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "odd_msgs" / "msg"
    folder.mkdir(parents=True)
    (folder / "__init__.py").write_text("from odd_msgs.msg._odd import Odd\n")
    (folder / "_odd.py").write_text("class Odd(:\n")
    monkeypatch.setattr(sys, "path", [str(tmp_path)])
    installed.cache_clear()
    installed_fields.cache_clear()
    try:
        assert set(installed()) == {"odd_msgs/msg/Odd"}
        assert installed_fields("odd_msgs/msg/Odd", "Odd") == {}
    finally:
        installed.cache_clear()
        installed_fields.cache_clear()
