"""Connections that have not sent a token yet: their limits, and the order in which they are closed."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import socket
    from collections.abc import Iterator


@dataclass(eq=False, slots=True)
class Caller:
    """A connection to a door, or to the keeper's entrance.

    Attributes:
        door: the name of the door at which it arrived; "" for the keeper's entrance.
        deadline_s: the time at which its request must be complete.
        heard: the bytes received so far.
        descriptors: the received file descriptors; closed if they are not used.
    """

    connection: socket.socket
    door: str
    deadline_s: float
    heard: bytes = b""
    descriptors: list[int] = field(default_factory=list)


class Callers:
    """Limits the connections at each door and in total; the oldest ones are closed first.

    Args:
        per_door: the limit at one door.
        in_all: the limit at all doors.
    """

    def __init__(self, *, per_door: int, in_all: int) -> None:
        self._per_door = per_door
        self._in_all = in_all
        self._by_door: dict[str, dict[Caller, None]] = {}
        self._count = 0

    def __len__(self) -> int:
        return self._count

    def __contains__(self, caller: Caller) -> bool:
        return caller in self._by_door.get(caller.door, {})

    def __iter__(self) -> Iterator[Caller]:
        for waiting in self._by_door.values():
            yield from waiting

    def add(self, caller: Caller) -> list[Caller]:
        """Admits a connection; returns the connections that must be closed for it."""
        waiting = self._by_door.setdefault(caller.door, {})
        gone = []
        if len(waiting) >= self._per_door:
            gone.append(next(iter(waiting)))
        elif self._count >= self._in_all and (oldest := self.first_to_go()) is not None:
            gone.append(oldest)
        for one in gone:
            self.discard(one)
        self._by_door.setdefault(caller.door, {})[caller] = None
        self._count += 1
        return gone

    def discard(self, caller: Caller) -> None:
        """Removes a connection, if it is known."""
        waiting = self._by_door.get(caller.door, {})
        if caller not in waiting:
            return
        del waiting[caller]
        self._count -= 1
        if not waiting:
            del self._by_door[caller.door]

    def first_to_go(self) -> Caller | None:
        """Returns the oldest connection at the door with the most connections.

        So a flood at one door does not affect others.
        """
        fullest = max(self._by_door.values(), key=len, default=None)
        return next(iter(fullest)) if fullest else None

    def overdue(self, now_s: float) -> list[Caller]:
        """Returns the connections whose deadline has passed."""
        return [caller for caller in self if caller.deadline_s <= now_s]

    def at(self, door: str) -> list[Caller]:
        """Returns the connections at one door."""
        return list(self._by_door.get(door, {}))
