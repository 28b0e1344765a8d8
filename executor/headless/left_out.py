"""Names the launch nodes that a run in simulated time leaves out: their processes live in real time."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from executor.headless.files import write_files
from executor.launching.reader import read_launch_files
from translator.package.launch_files import launch_files

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["left_out"]


def left_out(files: Mapping[str, bytes]) -> list[str]:
    """Returns a line with its place for each launch node of a project.

    Raises:
        DocumentError: a launch file cannot be read; a run in real time would not begin.
    """
    if not launch_files(files):
        return []
    with tempfile.TemporaryDirectory(prefix="bt-studio-") as folder:
        write_files(Path(folder), files)
        plan = read_launch_files(Path(folder))
    why = "it runs in real time, and this run in simulated time"
    return [
        f"{node.file}:{node.line}:1: the launch node {node.name} is left out: {why}" for node in plan.nodes
    ]
