"""The state that several web workers of one parent share: numbers, and a limited number of places.

While the parent (`parent.py`) serves, it keeps a folder. The folder has a page of numbers for each worker,
and an empty file for each place. A worker that holds a place holds the lock of the place's file, which the
kernel releases when a worker is killed. A server without a parent keeps places in its own memory.
"""

from __future__ import annotations

import asyncio
import fcntl
import hashlib
import os
import time
from collections import Counter
from contextlib import suppress
from typing import TYPE_CHECKING, Final, NamedTuple

from backend.core.processes.numbers import BEAT, FULL, STARTED, STUCK, numbers

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from backend.core.processes.threads import Threads

BEAT_EVERY_S: Final = 1.0
PAGE: Final = "worker-{}.numbers"
PLACES: Final = "places"
POOL: Final = "pool.sock"


class Family(NamedTuple):
    """The workers of one parent.

    Attributes:
        folder: the shared folder, which exists while the parent serves.
        size: the number of workers.
        own: the index of this worker, from 0.
    """

    folder: Path
    size: int
    own: int

    def pages(self) -> list[Path]:
        """Returns the paths of the pages of all workers."""
        return [self.folder / PAGE.format(number) for number in range(self.size)]


class _Siblings:
    """This process's view of its parent and siblings."""

    def __init__(self) -> None:
        self.family: Family | None = None
        self._taken: Counter[str] = Counter()

    def join(self, family: Family) -> None:
        """Makes this process one of several workers."""
        self.family = family
        numbers.share(family.pages(), family.own)

    def take(self, name: str, most: int) -> Place | None:
        """Takes one of `most` places that all workers share; returns None if all are taken."""
        if self.family is not None:
            return _locked(self.family.folder / PLACES, name, most)
        if self._taken[name] >= most:
            return None
        self._taken[name] += 1
        return Place(name, self._taken)


class Place:
    """A place that this process holds until it releases it."""

    def __init__(self, name: str, taken: Counter[str] | None, descriptor: int = -1) -> None:
        self._name, self._taken, self._descriptor = name, taken, descriptor

    def give_back(self) -> None:
        """Frees the place; further calls do nothing."""
        if self._taken is None:
            os.close(self._descriptor)
            return
        self._taken[self._name] -= 1
        if not self._taken[self._name]:
            del self._taken[self._name]


def _locked(folder: Path, name: str, most: int) -> Place | None:
    key = hashlib.sha256(name.encode()).hexdigest()[:32]
    for number in range(most):
        descriptor = os.open(folder / f"{key}-{number}", os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o600)
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
            return Place(name, None, descriptor)
        os.close(descriptor)
    return None


siblings: Final = _Siblings()


def answering() -> None:
    """Reports to the parent that this worker answers."""
    if siblings.family is not None:
        numbers.put(BEAT, time.monotonic())
        numbers.put(STARTED, 1)


async def beat_for_ever(threads: Threads) -> None:
    """Reports periodically that the event loop runs, and how busy the threads are.

    The parent and the siblings read it.
    """
    while True:
        numbers.put(FULL, threads.full_for_s())
        numbers.put(STUCK, threads.stuck_for_s())
        numbers.put(BEAT, time.monotonic())
        await asyncio.sleep(BEAT_EVERY_S)


def least_s(place: int, own_s: float) -> float:
    """Returns the shortest time in seconds for which a worker has been full (or stuck), over all workers.

    The time since a worker's last report is added to the reported value. Workers that have not started are
    left out.

    Args:
        place: FULL or STUCK.
        own_s: the current value of this worker.
    """
    if siblings.family is None:
        return own_s
    others = [page for number, page in enumerate(numbers.pages) if number != siblings.family.own]
    return min([own_s, *_lasting(others, place)])


def _lasting(pages: Iterable[memoryview[float]], place: int) -> list[float]:
    now = time.monotonic()
    late = ((page[place], now - page[BEAT]) for page in pages if page[STARTED])
    return [value + (age if age > 2 * BEAT_EVERY_S else 0.0) for value, age in late]
