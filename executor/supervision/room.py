"""Memory and processors: what a process has for itself alone, and what the container has."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final

__all__ = ["memory_room", "private_bytes", "processors"]

SHARE: Final = 0.6
"""The share of a container's memory that a session may use."""
_CGROUP: Final = Path("/sys/fs/cgroup")
_QUOTA: Final = _CGROUP / "cpu.max"
_PRIVATE: Final = ("Private_Clean:", "Private_Dirty:", "Swap:")


def private_bytes(pid: int) -> int:
    """Returns the memory that only this process has; 0 if it cannot be read."""
    try:
        lines = Path(f"/proc/{pid}/smaps_rollup").read_text().splitlines()
    except OSError:
        return 0
    return sum(int(line.split()[1]) << 10 for line in lines if line.startswith(_PRIVATE))


def memory_room(cgroup: Path = _CGROUP) -> int | None:
    """Returns the memory in bytes that the session may still take; negative if it has too much.

    None without a limit.
    """
    try:
        limit = int((cgroup / "memory.max").read_text())
        used = int((cgroup / "memory.current").read_text())
        stat = dict(line.split() for line in (cgroup / "memory.stat").read_text().splitlines())
    except (OSError, ValueError):  # no limit is the word “max”
        return None
    return round(limit * SHARE) - (used - int(stat.get("inactive_file", 0)))


def processors(quota: Path = _QUOTA) -> int:
    """Returns how many runs at a time the machine, or its container, has processors for."""
    count = len(os.sched_getaffinity(0))
    try:
        most, period = quota.read_text(encoding="ascii").split()
    except (OSError, ValueError):
        return count
    return count if most == "max" else max(1, min(count, int(most) // int(period)))
