"""Removes the shared memory that Fast DDS leaves in `/dev/shm` when its process is killed.

Each segment `fastrtps_<id>` has a file `fastrtps_<id>_el`, which its owner keeps locked during its life. In
the same way a port `fastrtps_port<number>` belongs to its reader. But if a process writes to a reader that
has ended, it creates the port again without a lock; `fastdds shm clean` does not remove such a port after the
writer is killed too.
"""

from __future__ import annotations

import contextlib
import re
from pathlib import Path
from typing import Final

from executor.supervision.locks import is_abandoned, is_young

__all__ = ["mapped_files", "remove_abandoned_segments"]

FOLDER: Final = Path("/dev/shm")  # noqa: S108 - it is where shared memory is, not a temporary file
LOCK_SUFFIX: Final = "_el"
PORT: Final = re.compile(r"fastrtps_port\d+")


def remove_abandoned_segments(folder: Path = FOLDER) -> int:
    """Removes the segments whose owner has ended; returns their number."""
    locks = list(folder.glob(f"fastrtps_*{LOCK_SUFFIX}"))
    abandoned = [lock.name.removesuffix(LOCK_SUFFIX) for lock in locks if is_abandoned(lock)]
    abandoned += _ports_of_nobody(folder)
    return sum(_is_removed(folder, name) for name in abandoned)


def mapped_files(processes: Path = Path("/proc")) -> set[str]:
    """Returns the files that processes have mapped, as far as permissions allow."""
    found: set[str] = set()
    for maps in processes.glob("[0-9]*/maps"):
        with contextlib.suppress(OSError):  # the process has ended, or belongs to another user
            lines = maps.read_text(errors="replace").splitlines()
            found.update(line[line.index("/") :] for line in lines if "/" in line)
    return found


def _ports_of_nobody(folder: Path) -> list[str]:
    locked = {lock.name.rsplit("_", 1)[0] for lock in folder.glob("fastrtps_port*_[es]l")}
    ports = [file for file in folder.glob("fastrtps_port*") if PORT.fullmatch(file.name)]
    suspects = [port for port in ports if port.name not in locked and not is_young(port)]
    if not suspects:
        return []
    mapped = mapped_files()
    return [port.name for port in suspects if str(port) not in mapped]


def _is_removed(folder: Path, name: str) -> bool:
    with contextlib.suppress(OSError):  # the file belongs to another user
        for file in (name, f"sem.{name}_mutex", f"{name}{LOCK_SUFFIX}"):
            (folder / file).unlink(missing_ok=True)
        return True
    return False
