"""Removes the shared memory that Fast DDS leaves in `/dev/shm` when its process is killed.

Each segment `fastrtps_<id>` has a file `fastrtps_<id>_el` on which its owner holds a lock while it lives.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import time
from pathlib import Path
from typing import Final

__all__ = ["remove_abandoned_segments"]

FOLDER: Final = Path("/dev/shm")  # noqa: S108 - it is where shared memory is, not a temporary file
LOCK_SUFFIX: Final = "_el"
YOUNGEST_S: Final = 1.0


def remove_abandoned_segments(folder: Path = FOLDER) -> int:
    """Removes the segments whose owner is gone; returns how many."""
    # An owner needs a moment from creating the file to locking it.
    newest = time.time() - YOUNGEST_S
    removed = 0
    for lock in folder.glob(f"fastrtps_*{LOCK_SUFFIX}"):
        with contextlib.suppress(OSError):
            if lock.stat().st_mtime < newest and _is_free(lock):
                name = lock.name.removesuffix(LOCK_SUFFIX)
                for file in (name, f"sem.{name}_mutex", lock.name):
                    lock.with_name(file).unlink(missing_ok=True)
                removed += 1
    return removed


def _is_free(lock: Path) -> bool:
    descriptor = os.open(lock, os.O_RDONLY | os.O_CLOEXEC)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    finally:
        os.close(descriptor)
    return True
