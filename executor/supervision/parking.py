"""Keeps the other threads of BT Studio without a lock while the main thread forks.

A thread holds its *spot* while it works, and leaves it while it waits. The main thread takes all spots before
it forks: then each other thread is at its wait, or waits for its spot.
"""

from __future__ import annotations

import threading
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["PARKING", "Parking"]


class Parking:
    """The spots of the threads of one process."""

    def __init__(self) -> None:
        self._spots: list[threading.Lock] = []

    def spot(self) -> threading.Lock:
        """Returns the spot of one more thread, which holds it while it works."""
        spot = threading.Lock()
        self._spots.append(spot)
        return spot

    def forget(self) -> None:
        """Forgets all spots: in a copy of the process, in which their threads do not exist."""
        self._spots = []

    @contextmanager
    def parked(self, patience_s: float) -> Iterator[bool]:
        """Keeps all threads from their work meanwhile; the value is False if one was busy for too long."""
        until_s = time.monotonic() + patience_s
        taken: list[threading.Lock] = []
        try:
            for spot in self._spots:
                if not spot.acquire(timeout=max(0.0, until_s - time.monotonic())):
                    break
                taken.append(spot)
            yield len(taken) == len(self._spots)
        finally:
            for spot in taken:
                spot.release()


PARKING = Parking()
"""The spots of this process."""
