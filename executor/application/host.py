"""Prepares every process that runs users' code, in a session or in lock-step."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from executor.application import compat
from executor.application.forks import limit_forks

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["enter", "prepare"]


def prepare() -> None:
    """Loads and installs the modules that actions expect. Call it after the ROS environment is set."""
    compat.warm_up()
    compat.install()


def enter(folder: Path) -> Callable[[], None]:
    """Makes the folder of the application the current folder, and its modules importable.

    Returns a function that undoes both. Modules of the project are searched last, after those of BT Studio
    and of Python.
    """
    before, paths = Path.cwd(), [str(folder), str(folder / "actions")]
    os.chdir(folder)
    sys.path += paths
    limit_forks()

    def leave() -> None:
        os.chdir(before)
        for path in paths:
            sys.path.remove(path)

    return leave
