"""The robots of a project, as the simulator reads them."""

from __future__ import annotations

import logging
import tempfile
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping

READ: Final = ("robots/", "assets/")
"""Beginnings of the paths of the files that a run gives to robots: no other file is found by them."""


def check_robots(files: Mapping[str, bytes]) -> tuple[list[str], list[str]]:
    """Returns the errors of a project's robots, and notes about what is left out; each has its file and line.

    Macros of xacro run in a child that reads only the project.

    Args:
        files: the files of the project, by their paths.
    """
    paths = [PurePosixPath(path) for path in files]
    robots = sorted(
        p.parts[1] for p in paths if len(p.parts) == 3 and (p.parts[0], p.name) == ("robots", "robot.yaml")
    )
    if not robots:
        return [], []
    from executor.headless.files import write_files
    from executor.robots import RobotError, load_robot

    logging.getLogger("executor.robots").setLevel(logging.ERROR)  # its notes are returned
    errors: list[str] = []
    notes: list[str] = []
    with tempfile.TemporaryDirectory(prefix="bt-studio-robots-") as folder:
        write_files(Path(folder), {path: data for path, data in files.items() if path.startswith(READ)})
        for robot in robots:
            try:
                found = load_robot(robot, Path(folder))
            except RobotError as error:
                errors += str(error).splitlines()
            else:
                file = found.urdf_path.relative_to(folder)
                notes += [f"{file}:{note}" for note in found.urdf.notes]
    return errors, notes
