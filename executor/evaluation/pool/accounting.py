"""Processor time and memory of processes, from /proc."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

SCRATCH_PREFIX: Final = "bt-studio-sealed-"
"""The beginning of the name of the folder that a sealed process may write."""
_TICK_S: Final = 1.0 / os.sysconf("SC_CLK_TCK")
_PAGE: Final = os.sysconf("SC_PAGE_SIZE")


class Usage(NamedTuple):
    """Processor time in s, with that of ended children, and memory in bytes."""

    cpu_s: float
    rss_bytes: int


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


def written_bytes(folder: str) -> int:
    """Returns the size of what sealed processes have written in the folder of a run.

    Where a sealed process has its own mounts, the kernel bounds it, and nothing is seen here.
    """
    found = 0
    with suppress(OSError):
        scratch = [entry.path for entry in os.scandir(folder) if entry.name.startswith(SCRATCH_PREFIX)]
        for at in scratch:
            for place, _, names in os.walk(at):
                found += sum(_size(f"{place}/{name}") for name in names)
    return found


def _size(path: str) -> int:
    with suppress(OSError):
        return os.lstat(path).st_blocks * 512
    return 0
