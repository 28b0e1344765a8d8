"""Memory and processors: what a process has for itself alone, and what the container has."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Final, NamedTuple

__all__ = ["memory_room", "private_bytes", "processors"]

SHARE: Final = 0.6
"""The share of a container's memory that a session may use."""
_CGROUP: Final = Path("/sys/fs/cgroup")
_OF_V1: Final = ("quota", "period")
_NO_LIMIT: Final = 1 << 62
"""What version 1 says of a group without a limit is about 2^63."""
_PRIVATE: Final = ("Private_Clean:", "Private_Dirty:", "Swap:")


class _Names(NamedTuple):
    """The files of a group's memory, and the line of `stat` for files that the kernel can drop."""

    limit: str
    used: str
    stat: str
    files: str


_MEMORY: Final = (
    _Names("memory.max", "memory.current", "memory.stat", "inactive_file"),
    _Names(
        "memory/memory.limit_in_bytes",
        "memory/memory.usage_in_bytes",
        "memory/memory.stat",
        "total_inactive_file",
    ),
)
"""Of version 2 of control groups, and of version 1."""


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
    for names in _MEMORY:
        try:
            limit = int((cgroup / names.limit).read_text())
            used = int((cgroup / names.used).read_text())
            stat = dict(line.split() for line in (cgroup / names.stat).read_text().splitlines())
        except (OSError, ValueError):  # another version, or no limit, which is the word “max”
            continue
        if limit < _NO_LIMIT:
            return round(limit * SHARE) - (used - int(stat.get(names.files, 0)))
    return None


def processors(cgroup: Path = _CGROUP) -> int:
    """Returns how many runs at a time the machine, or its container, has processors for."""
    count = len(os.sched_getaffinity(0))
    quota, period = _quota(cgroup)
    return max(1, min(count, quota // period)) if quota > 0 else count


def _quota(cgroup: Path) -> tuple[int, int]:
    """Returns the processor time that the container may take, and in what time; 0 is no limit."""
    try:
        quota, period = (cgroup / "cpu.max").read_text(encoding="ascii").split()
        return (0 if quota == "max" else int(quota)), int(period)
    except (OSError, ValueError):
        pass
    try:
        texts = ((cgroup / "cpu" / f"cpu.cfs_{name}_us").read_text(encoding="ascii") for name in _OF_V1)
        quota_us, period_us = map(int, texts)
    except (OSError, ValueError):
        return 0, 1
    return quota_us, period_us
