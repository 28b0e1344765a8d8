"""The project's files in a recording."""

from __future__ import annotations

import json
import os

import pytest

from executor.recorder.project_files import LONGEST_NAME, MOST_BYTES, project_files, project_name


def test_regular_files_are_read_and_no_others(tmp_path):
    (tmp_path / "actions").mkdir()
    (tmp_path / "actions" / "Go.py").write_bytes(b"go")
    (tmp_path / "__pycache__").mkdir()
    (tmp_path / "__pycache__" / "x.pyc").write_bytes(b"x")
    (tmp_path / "secret").symlink_to("/etc/passwd")
    os.mkfifo(tmp_path / "pipe")
    assert project_files(str(tmp_path)) == {"project/actions/Go.py": b"go"}


def test_the_sum_is_bounded(tmp_path):
    for number in range(4):
        (tmp_path / f"{number}.bin").write_bytes(bytes(MOST_BYTES // 2))
    (tmp_path / "9.txt").write_bytes(b"")
    assert sorted(project_files(str(tmp_path))) == ["project/0.bin", "project/1.bin", "project/9.txt"]


def test_the_diagrams_have_the_room_first_and_the_engine_has_none(tmp_path):
    for name in ("actions/a.py", "trees/Main.json", "tree_gardener/node.py"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).write_bytes(bytes(MOST_BYTES // 2 + 1))
    assert list(project_files(str(tmp_path))) == ["project/trees/Main.json"]


def test_the_universe_of_the_project_comes_last_if_it_fits(tmp_path):
    (tmp_path / "trees").mkdir()
    (tmp_path / "trees" / "Main.json").write_bytes(bytes(MOST_BYTES - 10))
    assert list(project_files(str(tmp_path), "name: Yard")) == ["project/trees/Main.json", "universe.yaml"]
    assert project_files(str(tmp_path), "name: Yard")["universe.yaml"] == b"name: Yard"
    assert list(project_files(str(tmp_path), "name: Garden")) == ["project/trees/Main.json"]


def test_a_folder_that_is_not_there_has_no_files():
    assert project_files("/nowhere/at/all") == {}


def test_a_project_has_the_name_of_its_settings():
    assert project_name({"project/project.json": b'{"name": "bump and go"}'}) == "bump and go"
    long = json.dumps({"name": "x" * 1000}).encode()
    assert project_name({"project/project.json": long}) == "x" * LONGEST_NAME


@pytest.mark.parametrize("text", [b"", b"{", b"[" * 100_000, b"[]", b"null", b'{"name": 7}', b"\xff"])
def test_settings_without_a_name_give_none(text):
    assert project_name({"project/project.json": text}) == ""
    assert project_name({}) == ""
