"""Numbers of this process in shared memory, which its siblings and its parent can read at any time.

A worker counts directly in its page, a file that all workers map. So a sum that one worker reads is never
older than a sum that another worker read before. The counts of a killed worker are not lost: its replacement
continues them. An aligned number is written atomically, so readers need no lock.
"""

from __future__ import annotations

import mmap
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

ROOM: Final = 256
"""Number of numbers in a page."""
_BYTES: Final = 8
# The parent reads these numbers, so their places are fixed and do not depend on the order of imports.
STARTED: Final = 0
"""The place of a flag in the page: 1 when the worker answers."""
BEAT: Final = 1
"""The place of the time, in seconds, at which the event loop last ran."""
FULL: Final = 2
"""The place of the seconds for which no request thread was free. They are of the time of `BEAT`."""
STUCK: Final = 3
"""The place of the seconds for which no request thread had finished a request.

They are of the time of `BEAT`.
"""
_FIRST_FREE: Final = 4


class Numbers:
    """The page of numbers of this process, and those of its siblings."""

    def __init__(self) -> None:
        self._own = memoryview(bytearray(_BYTES * ROOM)).cast("d")
        self._all: Sequence[memoryview[float]] = (self._own,)
        self._used = _FIRST_FREE

    def take(self, count: int) -> int:
        """Reserves `count` numbers; returns the place of the first.

        Raises:
            MemoryError: the page is full.
        """
        first, self._used = self._used, self._used + count
        if self._used > ROOM:
            raise MemoryError("the page of numbers is full")
        return first

    def share(self, pages: Sequence[Path], own: int) -> None:
        """Makes this process count in one of these pages. Call it before anything is counted."""
        self._all = [read_page(page) for page in pages]
        self._own = self._all[own]

    def add(self, place: int, amount: float) -> None:
        """Adds to a number. It is not thread-safe: the caller holds a lock."""
        self._own[place] += amount

    def put(self, place: int, value: float) -> None:
        """Sets a number."""
        self._own[place] = value

    def total(self, place: int) -> float:
        """Returns the sum of this number over all siblings."""
        return float(sum(page[place] for page in self._all))

    @property
    def pages(self) -> Sequence[memoryview[float]]:
        """The pages of all siblings, including that of this process."""
        return self._all


def make_page(path: Path) -> memoryview[float]:
    """Makes a page of zeros."""
    path.write_bytes(bytes(_BYTES * ROOM))
    return read_page(path)


def read_page(path: Path) -> memoryview[float]:
    """Maps a page into memory; all processes that map it see each write immediately."""
    with path.open("r+b") as file:
        return memoryview(mmap.mmap(file.fileno(), _BYTES * ROOM)).cast("d")


numbers: Final = Numbers()
