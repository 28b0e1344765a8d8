"""Launch nodes that may offer navigation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from executor.launching.navigators import may_navigate

if TYPE_CHECKING:
    from pathlib import Path


def test_the_nodes_of_nav2_may() -> None:
    assert may_navigate("nav2_bt_navigator", ("/opt/ros/lib/nav2_bt_navigator/bt_navigator",))
    assert not may_navigate("turtlesim", ("/opt/ros/lib/turtlesim/turtlesim_node", "nav2_msgs.py"))


def test_a_program_with_the_interfaces_of_nav2_may(tmp_path: Path) -> None:
    own, other = tmp_path / "navigator.py", tmp_path / "talker.py"
    own.write_text("from nav2_msgs.action import NavigateToPose\n")
    other.write_bytes(b"\xff print('hello')\n")
    assert may_navigate("", ("python3", str(own), "--loud"))
    assert not may_navigate("", ("python3", str(other), str(own)))
    assert not may_navigate("", ("python3", str(tmp_path / "missing.py")))
    assert not may_navigate("", ())


@pytest.mark.parametrize("denied", ["is_file", "read_bytes"])
def test_a_program_that_cannot_be_read_is_left_to_its_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, denied: str
) -> None:
    program = tmp_path / "navigator.py"
    program.write_text("import nav2_msgs\n")

    def deny(_: Path) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(type(program), denied, deny)
    assert not may_navigate("", ("python3", str(program)))
