"""The program that a node of a launch file names."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

import pytest

from executor.launching.find import NotFound, find_command, find_executable

if TYPE_CHECKING:
    from pathlib import Path

PYTHON = (sys.executable, "-P", "-m", "tree_gardener.ros_script")


def test_a_file_of_the_project_is_found_from_its_folder_and_the_launch_files(tmp_path: Path) -> None:
    (tmp_path / "launch").mkdir()
    talker = tmp_path / "launch" / "talker.py"
    talker.write_text("")
    for name in ("launch/talker.py", "talker.py"):
        assert find_command("", name, tmp_path, tmp_path / "launch") == (*PYTHON, str(talker))


def test_a_file_outside_of_the_project_is_not(tmp_path: Path) -> None:
    (tmp_path / "out.py").write_text("")
    root = tmp_path / "in"
    root.mkdir()
    with pytest.raises(NotFound, match="there is no file"):
        find_command("", "../out.py", root, root)


def test_an_executable_of_a_package_is_found_or_the_reason_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    with pytest.raises(NotFound, match="no ROS workspace is sourced"):
        find_command("demo", "talker", tmp_path, tmp_path)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    with pytest.raises(NotFound, match="there is no package 'demo'"):
        find_command("demo", "talker", tmp_path, tmp_path)
    program = tmp_path / "lib" / "demo" / "talker"
    program.parent.mkdir(parents=True)
    program.write_text("")
    os.chmod(program, 0o700)  # noqa: PTH101 - as one reads it in a shell
    assert find_command("demo", "talker", tmp_path / "x", tmp_path / "x") == (str(program),)


def test_a_program_of_the_machine_is_searched_in_its_path(tmp_path: Path) -> None:
    assert find_executable("python3", tmp_path, tmp_path) == (sys.executable,)
    with pytest.raises(NotFound, match="no program"):
        find_executable("no-such-program", tmp_path, tmp_path)
