"""Finds what keeps a project's own universes and launch files from a run, before the run.

Each universe is made as a run makes it, with its robots.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.headless.files import write_files
from executor.launching.reader import read_launch_files
from executor.universes.document import DocumentError, text_of
from translator.package.launch_files import launch_files

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.launching.model import LaunchPlan
    from translator import Project

__all__ = ["launch_notes", "problems_of"]

_UNIVERSES: Final = ("universes/", ".yaml")


def problems_of(project: Project) -> list[str]:
    """Returns the errors of universes and launch files, each with its file, line and code."""
    return [*_world_problems(project), *_launch_problems(project.files)]


def launch_notes(files: Mapping[str, bytes]) -> list[str]:
    """Returns a line for each part of the launch files that a run leaves out or cannot start."""
    try:
        plan = _launch_plan(files)
    except DocumentError:
        return []
    refused = [node for node in plan.nodes if node.refusal]
    return [*plan.notes, *(f"{node.file}:{node.line}:1: {node.name} {node.refusal}" for node in refused)]


def _launch_problems(files: Mapping[str, bytes]) -> list[str]:
    try:
        _launch_plan(files)
    except DocumentError as error:
        return str(error).splitlines()
    return []


def _launch_plan(files: Mapping[str, bytes]) -> LaunchPlan:
    from executor.launching.model import LaunchPlan  # noqa: PLC0415 - as a type it is not loaded

    if not launch_files(files):
        return LaunchPlan()
    with tempfile.TemporaryDirectory(prefix="bt-studio-") as folder:
        write_files(Path(folder), files)
        return read_launch_files(Path(folder))


def _world_problems(project: Project) -> list[str]:
    begin, end = _UNIVERSES
    files = sorted(path for path in project.files if path.startswith(begin) and path.endswith(end))
    if not files:
        return []
    from executor.world.simulation.launch import make_world  # noqa: PLC0415 - slow to load

    settings, found = project.settings, list[str]()
    with tempfile.TemporaryDirectory(prefix="bt-studio-") as folder:
        assets = {
            name: data for name, data in project.files.items() if name.startswith(("assets/", "robots/"))
        }
        write_files(Path(folder), assets)
        for file in files:
            robot = settings.robot if file == f"{begin}{settings.universe}{end}" else None
            try:
                text = text_of(project.files[file], file)
                make_world(text, robot=robot, assets=Path(folder), file=file).close()
            except DocumentError as error:
                found += str(error).splitlines()
    return list(dict.fromkeys(found))
