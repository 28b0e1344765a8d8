"""Bounds the bytes that this process holds for those who read its answers.

Bytes count from the moment when an answer's contents are fetched until the client has received it, so that
clients who ask for much and read nothing cannot fill the memory. Each worker of a server gets an equal part
of the limit of all owners.
"""

from __future__ import annotations

import threading
from collections import Counter
from contextvars import ContextVar
from functools import lru_cache
from typing import Final

from backend.config.environment import environment
from backend.core.problems import ServerBusyError
from backend.core.processes.siblings import siblings

SMALL: Final = 64 * 1024
"""Bytes; an answer that is not larger is counted, but never refused."""


class ReadersBusyError(ServerBusyError):
    """The answers that an owner, or all owners, have not read yet have reached the limit."""


class Held:
    """Bytes that are held for a reader, until `close`."""

    def __init__(self, readers: Readers, owner: str, size: int) -> None:
        self._readers, self._owner, self._size = readers, owner, size

    @property
    def size(self) -> int:
        """The number of bytes."""
        return self._size

    def resize(self, size: int) -> None:
        """Sets the number of bytes; never refuses."""
        self._readers._add(self._owner, size - self._size)
        self._size = size

    def grow(self, size: int, own: int) -> bool:
        """Counts more bytes; returns False if the owner, or all owners, hold too many then.

        Args:
            size: the number of further bytes.
            own: the number of bytes that the owner may hold.

        Up to `SMALL` bytes pass whatever others hold, and any number if the others hold no more than that.
        """
        return self._readers._grow(self, size, own)

    def close(self) -> None:
        """Releases the bytes; further calls do nothing."""
        self.resize(0)


class Readers:
    """The bytes that are held for readers.

    Args:
        per_owner: the largest number of bytes of one owner; None for no such limit.
        most: the largest number of bytes of all owners together.

    An answer that is larger than a limit passes if nothing else counts against that limit.
    """

    def __init__(self, per_owner: int | None, most: int) -> None:
        self._per_owner, self._most = per_owner, most
        self._lock = threading.Lock()
        self._held: Counter[str] = Counter()
        self._total = 0

    @property
    def most(self) -> int:
        """The largest number of bytes of all owners together."""
        return self._most

    @property
    def total(self) -> int:
        """The number of bytes that are held for all owners."""
        return self._total

    def take(self, owner: str, size: int, *, own: int = 0, must: bool = False) -> Held:
        """Counts bytes for an owner.

        Args:
            owner: who reads the answer.
            size: the number of bytes.
            own: the number of bytes that the same request holds already: it does not wait for itself.
            must: whether they are counted even beyond the limits, as for the answer to a write that is done.

        Raises:
            ReadersBusyError: the owner, or all owners together, have not read too much already.
        """
        with self._lock:
            mine, all_others = self._held[owner] - own, self._total - own
            is_over = self._per_owner is not None and mine and mine + own + size > self._per_owner
            is_full = all_others and all_others + own + size > self._most
            if not must and size > SMALL and (is_over or is_full):
                who = "your other requests" if is_over else "other requests"
                raise ReadersBusyError(
                    f"The answers to {who} are still on their way and take all the memory for them.",
                    hint="Wait until they have arrived, then try again.",
                )
            self._change(owner, size)
        return Held(self, owner, size)

    def of(self, owner: str) -> Held:
        """Returns what an owner holds from now on: no bytes yet."""
        return Held(self, owner, 0)

    def _grow(self, held: Held, size: int, own: int) -> bool:
        with self._lock:
            self._change(held._owner, size)
            held._size += size
            is_alone = self._total - held._size <= SMALL
            is_full = held._size > SMALL and not is_alone and self._total > self._most
            return self._held[held._owner] <= own and not is_full

    def _add(self, owner: str, size: int) -> None:
        with self._lock:
            self._change(owner, size)

    def _change(self, owner: str, size: int) -> None:
        self._total += size
        self._held[owner] += size
        if self._held[owner] <= 0:
            del self._held[owner]


@lru_cache(maxsize=1)
def readers() -> Readers:
    """Returns the readers of this process."""
    settings = environment()
    workers = siblings.family.size if siblings.family else 1
    per_owner = settings.max_unread_bytes_per_owner if settings.is_team else None
    return Readers(per_owner, settings.max_unread_bytes // workers)


class Reading:
    """The bytes that one request holds, from the first content that it fetches until its answer has arrived.

    Args:
        owner: who reads the answer.
    """

    def __init__(self, owner: str) -> None:
        self._owner = owner
        self._held: list[Held] = []

    def reserve(self, size: int) -> None:
        """Counts bytes that are fetched next."""
        own = sum(held.size for held in self._held)
        self._held.append(readers().take(self._owner, size, own=own))

    def settle(self, size: int, *, must: bool) -> None:
        """Counts the answer instead of all that was fetched for it.

        Raises:
            ReadersBusyError: nothing was counted before, and too many answers are not read yet.
        """
        if not self._held:
            self._held = [readers().take(self._owner, size, must=must)]
        first, *others = self._held
        first.resize(size)
        self._held = [first]
        for held in others:
            held.close()

    def close(self) -> None:
        """Releases all bytes: the answer has arrived, or never will."""
        for held in self._held:
            held.close()
        self._held = []


reading: Final[ContextVar[Reading | None]] = ContextVar("reading", default=None)
"""The bytes that the current request holds."""


def reserve(size: int) -> None:
    """Counts bytes that the current request needs, before they are fetched.

    Outside of requests, as in commands of the terminal, it does nothing.

    Raises:
        ReadersBusyError: too many answers are not read yet.
    """
    if (found := reading.get()) is not None:
        found.reserve(size)


def release() -> None:
    """Releases what the current request has counted so far, since it needs those contents no longer."""
    if (found := reading.get()) is not None:
        found.close()
