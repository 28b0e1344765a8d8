"""Processor time and memory of a process with all its descendants, from /proc."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

_TICK_S: Final = 1.0 / os.sysconf("SC_CLK_TCK")
_PAGE: Final = os.sysconf("SC_PAGE_SIZE")


class Usage(NamedTuple):
    """Processor time in s, with that of ended children, and memory in bytes."""

    cpu_s: float
    rss_bytes: int


def descendants(pid: int) -> list[int]:
    """Returns all living descendants of a process, parents first."""
    found: list[int] = []
    line = [pid]
    while line:
        for child in _children(line.pop()):
            found.append(child)
            line.append(child)
    return found


def usage(pids: Iterable[int]) -> Usage:
    """Returns the sum of the resources of some processes; ended processes count as zero."""
    cpu_s, rss = 0.0, 0
    for pid in pids:
        try:
            fields = Path(f"/proc/{pid}/stat").read_bytes().rpartition(b") ")[2].split()
        except OSError:
            continue
        cpu_s += sum(int(fields[index]) for index in (11, 12, 13, 14)) * _TICK_S
        rss += int(fields[21]) * _PAGE
    return Usage(cpu_s, rss)


def _children(pid: int) -> list[int]:
    found: list[int] = []
    try:
        for task in os.scandir(f"/proc/{pid}/task"):
            found += map(int, Path(task.path, "children").read_bytes().split())
    except OSError:
        pass
    return found
