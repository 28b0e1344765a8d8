"""Whether this process is one of several web workers of one parent, and what they know of each other.

The parent (`parent.py`) makes a folder while it serves. In it are a page of numbers for each worker, and
empty files that stand for a place of which there are only so many: who holds a place holds the file's lock,
and a worker that is killed holds none any more. A server without a parent has places in its own memory.
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
        folder: what they share while the parent lives.
        size: how many they are.
        own: the number of this one, from 0.
    """

    folder: Path
    size: int
    own: int

    def pages(self) -> list[Path]:
        """The pages of all workers."""
        return [self.folder / PAGE.format(number) for number in range(self.size)]


class _Siblings:
    """This process's view of its parent and siblings."""

    def __init__(self) -> None:
        self.family: Family | None = None
        self._taken: Counter[str] = Counter()

    def join(self, family: Family) -> None:
        """From now on this process is one of several."""
        self.family = family
        numbers.share(family.pages(), family.own)

    def take(self, name: str, most: int) -> Place | None:
        """One of so many places for all workers together; None where all are taken."""
        if self.family is not None:
            return _locked(self.family.folder / PLACES, name, most)
        if self._taken[name] >= most:
            return None
        self._taken[name] += 1
        return Place(name, self._taken)


class Place:
    """A place that is held until it is given back."""

    def __init__(self, name: str, taken: Counter[str] | None, descriptor: int = -1) -> None:
        self._name, self._taken, self._descriptor = name, taken, descriptor

    def give_back(self) -> None:
        """Frees the place for another; once."""
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
    """Reports to parent and siblings that the event loop is awake, and how busy the threads are."""
    while True:
        numbers.put(FULL, threads.full_for_s())
        numbers.put(STUCK, threads.stuck_for_s())
        numbers.put(BEAT, time.monotonic())
        await asyncio.sleep(BEAT_EVERY_S)


def least_s(place: int, own_s: float) -> float:
    """For how long it has been so of the worker that is best off: FULL or STUCK.

    What a worker said long ago has lasted since; one that has not started says nothing.

    Args:
        place: which of them.
        own_s: what it is here and now.
    """
    if siblings.family is None:
        return own_s
    others = [page for number, page in enumerate(numbers.pages) if number != siblings.family.own]
    return min([own_s, *_lasting(others, place)])


def _lasting(pages: Iterable[memoryview[float]], place: int) -> list[float]:
    now = time.monotonic()
    late = ((page[place], now - page[BEAT]) for page in pages if page[STARTED])
    return [value + (age if age > 2 * BEAT_EVERY_S else 0.0) for value, age in late]
