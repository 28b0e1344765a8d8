"""A temporary folder that is removed after its process has ended, even if the process was killed.

The owner keeps a file in the folder locked. When a new folder is created, all folders whose lock is no longer
held are removed.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import tempfile
from pathlib import Path
from typing import Final

from executor.supervision.locks import is_abandoned, is_young

__all__ = ["PREFIX", "Scratch", "is_in_use", "remove_abandoned"]

PREFIX: Final = "bt-studio-session-"
LOCK: Final = ".lock"


class Scratch:
    """A temporary folder of this process.

    Raises:
        OSError: the disk is full.
    """

    def __init__(self) -> None:
        remove_abandoned(Path(tempfile.gettempdir()))
        self.path = Path(tempfile.mkdtemp(prefix=PREFIX))
        self._lock = os.open(self.path / LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        fcntl.flock(self._lock, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def remove(self) -> None:
        """Removes the folder with its content. May be called twice."""
        shutil.rmtree(self.path, ignore_errors=True)
        if self._lock >= 0:
            os.close(self._lock)
            self._lock = -1


def is_in_use(path: Path) -> bool:
    """Returns whether a path is the temporary folder of a process that still runs."""
    lock = path / LOCK
    # Its owner may have made a young folder, and not yet locked it.
    is_kept = is_young(path) or (lock.is_file() and not is_abandoned(lock))
    return path.name.startswith(PREFIX) and is_kept


def remove_abandoned(place: Path) -> None:
    """Removes the folders of processes that were killed."""
    for lock in place.glob(f"{PREFIX}*/{LOCK}"):
        if is_abandoned(lock):
            shutil.rmtree(lock.parent, ignore_errors=True)
