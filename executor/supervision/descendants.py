"""All processes that come from this one, found without reading each time about all of the machine."""

from __future__ import annotations

import contextlib
import os
from typing import Final

import psutil

__all__ = ["Descendants"]

NOBODY: Final = 0
"""The parent of the first process, of the kernel's, and of those that came from outside of a container."""
FORGET_EVERY: Final = 16
"""Looks after which all is read anew: the number of a process that ended may have been given to another."""


class Descendants:
    """Looks for the children of this process, and theirs, again and again.

    Who descends from a sub-reaper does so for life, and who does not never will: so only what is new since
    the last look is asked for its parent.
    """

    def __init__(self) -> None:
        self._found: dict[int, psutil.Process] = {}
        self._others: set[int] = set()
        self._looks = 0

    def look(self) -> list[psutil.Process]:
        """Returns those that are there now, also those that have ended and wait to be collected."""
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
        """Tells the new ones that are ours from others, parents before their children."""
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
            # Else its parent came or went while we looked: the next look will tell.


def _parent_of(pid: int) -> int | None:
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:  # noqa: PTH123 - hundreds of times: no time for a Path
            return int(file.read().rpartition(b") ")[2].split()[1])
    except (OSError, ValueError, IndexError):
        return None
