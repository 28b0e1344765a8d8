"""Removes the shared memory that Fast DDS leaves in `/dev/shm` when its process is killed.

Each segment `fastrtps_<id>` has a file `fastrtps_<id>_el` on which its owner holds a lock while it lives.
"""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Final

from executor.supervision.locks import is_abandoned

__all__ = ["remove_abandoned_segments"]

FOLDER: Final = Path("/dev/shm")  # noqa: S108 - it is where shared memory is, not a temporary file
LOCK_SUFFIX: Final = "_el"


def remove_abandoned_segments(folder: Path = FOLDER) -> int:
    """Removes the segments whose owner is gone; returns how many."""
    removed = 0
    for lock in folder.glob(f"fastrtps_*{LOCK_SUFFIX}"):
        if is_abandoned(lock):
            with contextlib.suppress(OSError):  # somebody else was quicker
                name = lock.name.removesuffix(LOCK_SUFFIX)
                for file in (name, f"sem.{name}_mutex", lock.name):
                    lock.with_name(file).unlink(missing_ok=True)
                removed += 1
    return removed
