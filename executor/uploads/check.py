"""Reads the robots of a project, as the simulator does, for a check."""

from __future__ import annotations

import logging
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any

from executor.robots import RobotError, load_robot

if TYPE_CHECKING:
    from pathlib import Path


def check(project: Path) -> list[dict[str, Any]]:
    """Returns the errors of the robots of a project that have macros, each with file and line."""
    logging.getLogger("executor.robots").setLevel(logging.CRITICAL)
    found: list[dict[str, Any]] = []
    for folder in sorted(path.parent for path in project.glob("robots/*/robot.yaml")):
        if any(folder.rglob("*.xacro")):
            try:
                load_robot(folder.name, project)
            except RobotError as error:
                found += [
                    {"file": _in_project(error.file, folder.name), "line": item.line, "message": item.message}
                    for item in error.problems
                ]
    return found


def _in_project(file: str, robot: str) -> str:
    path = PurePosixPath(file)
    return file if path.parts[:1] == ("robots",) else f"robots/{robot}/{file}"
