"""The processor time of this process and of all that it started, also of orphans, from /proc."""

from __future__ import annotations

import os
import resource
from pathlib import Path
from typing import Final, NamedTuple

_TICKS_PER_S: Final = os.sysconf("SC_CLK_TCK")
# Positions in /proc/PID/stat after the name in brackets: parent, times of the process, times of the
# children that
# it waited for, start.
_PARENT, _TIMES, _START = 1, slice(11, 15), 19


class _Process(NamedTuple):
    parent: int
    start: int
    ticks: int


class ProcessorTime:
    """Counts from its making on; `read` returns seconds, which never fall."""

    def __init__(self) -> None:
        self.alive: dict[tuple[int, int], int] = {}
        """The descendants at the last reading, by process id and start, with their times in ticks."""
        self._orphans: set[tuple[int, int]] = set()
        self._lost_ticks = 0
        self._last_s = 0.0

    def read(self) -> float:
        """Returns the seconds of this process, of the descendants that ended and of those that live."""
        before, orphans = self.alive, self._orphans
        self._find_descendants()
        # No process of ours has waited for an orphan.
        self._lost_ticks += sum(before[each] for each in orphans if each not in self.alive)
        own = resource.getrusage(resource.RUSAGE_SELF)
        ended = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = own.ru_utime + own.ru_stime + ended.ru_utime + ended.ru_stime
        seconds += (sum(self.alive.values()) + self._lost_ticks) / _TICKS_PER_S
        self._last_s = max(self._last_s, seconds)
        return self._last_s

    def _find_descendants(self) -> None:
        processes = dict(_processes())
        children: dict[int, list[int]] = {}
        for pid, process in processes.items():
            children.setdefault(process.parent, []).append(pid)
        known = [pid for pid, start in self.alive if pid in processes and processes[pid].start == start]
        waiting, found = [*known, *children.get(os.getpid(), [])], set[int]()
        while waiting:
            pid = waiting.pop()
            if pid not in found:
                found.add(pid)
                waiting += children.get(pid, [])
        self.alive = {(pid, processes[pid].start): processes[pid].ticks for pid in found}
        ours = found | {os.getpid()}
        self._orphans = {each for each in self.alive if processes[each[0]].parent not in ours}


def _processes() -> list[tuple[int, _Process]]:
    found: list[tuple[int, _Process]] = []
    for entry in os.scandir("/proc"):
        if not entry.name.isdigit():
            continue
        try:
            stat = Path(entry.path, "stat").read_bytes()
        except OSError:
            continue  # it ended
        fields = stat.rpartition(b")")[2].split()
        ticks = sum(map(int, fields[_TIMES]))
        found.append((int(entry.name), _Process(int(fields[_PARENT]), int(fields[_START]), ticks)))
    return found
