"""Finds the program that a node of a launch file names."""

from __future__ import annotations

import os
import shutil
import sys
from importlib.util import find_spec
from pathlib import Path

__all__ = ["LAUNCH_PY_REFUSAL", "find_command", "find_executable", "has_launch"]

LAUNCH_PY_REFUSAL = (
    "cannot be started: the Python package `launch` of ROS 2 is not installed here. "
    "It runs in the exported package; for BT Studio write the nodes into a .launch.yaml file."
)


class NotFound(Exception):  # noqa: N818 - an answer, not a failure of ours
    """The program does not exist; the text says where it was searched."""


def has_launch() -> bool:
    """Returns whether ROS 2's `launch` can be imported."""
    return find_spec("launch") is not None


def find_command(package: str, executable: str, root: Path, folder: Path) -> tuple[str, ...]:
    """Returns the command of a node's `pkg` and `exec`.

    Args:
        package: a ROS package, or "" for a file of the project.
        executable: its name in the package, or the path of a file.
        root: the project's folder, searched first for a file.
        folder: the folder of the launch file, searched second.

    Raises:
        NotFound: there is no such program.
    """
    own = _own_file(executable, root, folder)
    if own is not None:
        return _python(own) if own.suffix == ".py" else (str(own),)
    if not package:
        raise NotFound(f"there is no file {executable!r} in the project")
    prefixes = [p for p in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if p]
    for prefix in prefixes:
        found = Path(prefix) / "lib" / package / executable
        if found.is_file() and os.access(found, os.X_OK):
            return (str(found),)
    if not prefixes:
        where = "no ROS workspace is sourced where BT Studio was started"
    elif any((Path(prefix) / "share" / package).is_dir() for prefix in prefixes):
        where = f"the package {package!r} is there, but has no such executable"
    else:
        where = f"there is no package {package!r} in {', '.join(prefixes)}"
    raise NotFound(
        f"the executable {executable!r} of the package {package!r} cannot be found: {where}. "
        "A Python file of the project is named by its path, such as launch/talker.py"
    )


def find_executable(name: str, root: Path, folder: Path) -> tuple[str, ...]:
    """Returns the command for the program that the first word of a command line names.

    Raises:
        NotFound: there is no such program.
    """
    own = _own_file(name, root, folder)
    if own is not None and own.suffix == ".py":
        return _python(own)
    found = str(own) if own is not None else shutil.which(name)
    if name in {"python", "python3"}:
        found = sys.executable
    if found is None:
        raise NotFound(f"there is no program {name!r} on this machine")
    return (found,)


def _python(file: Path) -> tuple[str, ...]:
    """Returns the command that runs a Python file; what it does wrong is said with its place."""
    return (sys.executable, "-P", "-m", "tree_gardener.ros_script", str(file))


def _own_file(name: str, root: Path, folder: Path) -> Path | None:
    """Returns a file of the project; None if it does not exist or is outside of the project."""
    for base in (root, folder):
        path = (base / name).resolve()
        if path.is_file() and path.is_relative_to(root.resolve()):
            return path
    return None
