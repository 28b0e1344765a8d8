"""Files that a process keeps locked during its life."""

from __future__ import annotations

import fcntl
import os
import time
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["is_abandoned", "is_young"]

# Seconds. A younger file may be unlocked because its owner has just created it, and not yet locked it.
YOUNGEST_S: Final = 1.0


def is_young(file: Path) -> bool:
    """Returns whether a file was made less than a moment ago, or does not exist."""
    try:
        return _is_recent(file.stat(follow_symlinks=False))
    except OSError:
        return True


def is_abandoned(lock: Path) -> bool:
    """Returns whether no process holds the lock any more.

    False for a file that cannot be opened, since it belongs to another user.
    """
    try:
        descriptor = os.open(lock, os.O_RDONLY | os.O_CLOEXEC | os.O_NOFOLLOW)
    except OSError:
        return False
    try:
        if _is_recent(os.fstat(descriptor)):
            return False
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    finally:
        os.close(descriptor)
    return True


def _is_recent(status: os.stat_result) -> bool:
    # A time in the future does not count as recent, since it would protect the file forever.
    return abs(time.time() - status.st_mtime) < YOUNGEST_S
