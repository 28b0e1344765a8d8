"""The launch nodes that a run in simulated time leaves out are named with their places."""

from __future__ import annotations

import pytest

from executor.headless.left_out import left_out
from executor.universes.document import DocumentError


def test_each_node_is_named():
    files = {
        "launch/a.launch.yaml": b"launch:\n- node: {exec: launch/talker.py, name: talker}\n",
        "launch/b_launch.py": b"",
        "launch/talker.py": b"",
    }
    why = "is left out: it runs in real time, and this run in simulated time"
    assert left_out(files) == [
        f"launch/a.launch.yaml:2:1: the launch node talker {why}",
        f"launch/b_launch.py:1:1: the launch node b_launch.py {why}",
    ]


def test_a_project_without_launch_files_leaves_out_none():
    assert left_out({"launch/params.yaml": b""}) == []


def test_a_file_that_cannot_be_read_is_refused():
    with pytest.raises(DocumentError, match="a launch file is"):
        left_out({"launch/a.launch.yaml": b"nodes: []"})
