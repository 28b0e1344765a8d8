"""What every process has that runs users' code, in a session and in lock-step alike."""

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
    """Loads and offers what actions take for granted. Call it once ROS has its environment."""
    compat.warm_up()
    compat.install()


def enter(folder: Path) -> Callable[[], None]:
    """Goes where the application is: its files and modules are found by name; gives the way back.

    Modules of the project come last: ours and Python's go before them.
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
