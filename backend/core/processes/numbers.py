"""Numbers of this process in a page of memory, which its siblings and its parent may read at every moment.

A worker counts straight into its page, a file that all of them map. So what one says of all is never older
than what another said before, and what a worker counted is there when it was killed; the one that takes its
place counts on. An aligned number is written as a whole.
"""

from __future__ import annotations

import mmap
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

ROOM: Final = 256
"""Numbers in a page."""
_BYTES: Final = 8
# What the parent reads, too, has its place whatever is imported first.
STARTED: Final = 0
"""1 once the worker answers."""
BEAT: Final = 1
"""When its event loop was awake last."""
FULL: Final = 2
"""For how long, then, no request thread had been free."""
STUCK: Final = 3
"""For how long, then, no request thread had come to the end of a request."""
_FIRST_FREE: Final = 4


class Numbers:
    """The page of this process, and those of its siblings."""

    def __init__(self) -> None:
        self._own = memoryview(bytearray(_BYTES * ROOM)).cast("d")
        self._all: Sequence[memoryview[float]] = (self._own,)
        self._used = _FIRST_FREE

    def take(self, count: int) -> int:
        """The first of so many numbers that nothing else uses.

        Raises:
            MemoryError: the page is full.
        """
        first, self._used = self._used, self._used + count
        if self._used > ROOM:
            raise MemoryError("the page of numbers is full")
        return first

    def share(self, pages: Sequence[Path], own: int) -> None:
        """From now on counts in one of these pages; before anything was counted."""
        self._all = [read_page(page) for page in pages]
        self._own = self._all[own]

    def add(self, place: int, amount: float) -> None:
        """Adds to a number; the caller sees to it that one thread at a time does."""
        self._own[place] += amount

    def put(self, place: int, value: float) -> None:
        """Sets a number."""
        self._own[place] = value

    def total(self, place: int) -> float:
        """The sum of this number over all siblings."""
        return float(sum(page[place] for page in self._all))

    @property
    def pages(self) -> Sequence[memoryview[float]]:
        """The pages of all siblings, this process' own among them."""
        return self._all


def make_page(path: Path) -> memoryview[float]:
    """Makes a page that is all noughts."""
    path.write_bytes(bytes(_BYTES * ROOM))
    return read_page(path)


def read_page(path: Path) -> memoryview[float]:
    """Maps a page; what is written into it is in the others' at once."""
    with path.open("r+b") as file:
        return memoryview(mmap.mmap(file.fileno(), _BYTES * ROOM)).cast("d")


numbers: Final = Numbers()
