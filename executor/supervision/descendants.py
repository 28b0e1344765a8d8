"""The descendants of a process, and the end of those that users' code starts in a run."""

from __future__ import annotations

import contextlib
import os
from typing import Final

import psutil

from tree_gardener.descendants import RunChildren, descendants

__all__ = ["Descendants", "RunChildren", "descendants"]

NOBODY: Final = 0
"""The parent id of the first process, of kernel threads, and of processes from outside of a container."""
FORGET_EVERY: Final = 16
"""Number of calls after which all processes are read again, since process ids are reused."""


class Descendants:
    """Finds the descendants of this process in repeated calls.

    A descendant of a sub-reaper remains a descendant for its life, and no other process becomes one. So the
    parent is read only of processes that are new since the last call.
    """

    def __init__(self) -> None:
        self._found: dict[int, psutil.Process] = {}
        self._others: set[int] = set()
        self._looks = 0

    def look(self) -> list[psutil.Process]:
        """Returns the current descendants, including zombies."""
        if self._looks % FORGET_EVERY == 0:
            self._found.clear()
            self._others.clear()
        self._looks += 1
        there = set(psutil.pids())
        self._others &= there
        self._found = {pid: process for pid, process in self._found.items() if pid in there}
        self._sort(there - self._others - self._found.keys())
        return list(self._found.values())

    def _sort(self, new: set[int]) -> None:
        """Sorts new processes into descendants and others; handles parents before their children."""
        parents = {pid: _parent_of(pid) for pid in new}
        own = os.getpid()
        for pid in new - {own}:
            line = [pid]
            while (parent := parents[line[-1]]) in new and parent != own and parent not in line:
                line.append(parent)
            if parent == own or parent in self._found:
                for one in reversed(line):
                    if one not in self._found:
                        with contextlib.suppress(psutil.Error):
                            self._found[one] = psutil.Process(one)
            elif parent == NOBODY or parent in self._others:
                self._others.update(line)
            # Otherwise the parent started or ended during the scan, and the next call decides.


def _parent_of(pid: int) -> int | None:
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:  # noqa: PTH123 - hundreds of times: no time for a Path
            return int(file.read().rpartition(b") ")[2].split()[1])
    except (OSError, ValueError, IndexError):
        return None
