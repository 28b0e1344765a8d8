"""Books what a connection costs the event loop: who uses more than their share is read later.

Heads, frames and connections that are refused cost no request thread, but each takes the event loop, for
which everybody waits.
"""

from __future__ import annotations

import time
from collections import Counter
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

from backend.config.environment import environment
from backend.core.clients import address_of, stranger
from backend.core.processes.budgets import budgets

if TYPE_CHECKING:
    from collections.abc import Iterator

COSTS: Final = "bt_studio.connection_costs"
"""The `ConnectionCosts` in the scope of a request or a socket."""
MOST_UNFINISHED: Final = 128 << 20
"""Bytes of messages that are not whole yet, of all sockets of one owner: twice the largest message."""
_unfinished: Final[Counter[str]] = Counter()


class ConnectionCosts:
    """The costs of one connection, and who pays them.

    Args:
        address: the other end's.

    Attributes:
        owner: who pays. It is the address until more is known; where that is a proxy's, nobody.
    """

    def __init__(self, address: str | None) -> None:
        settings = environment()
        self._is_on = settings.is_team
        self.owner = None if settings.proxy_hops else stranger(address_of(address, {}))
        self._held = 0

    @contextmanager
    def booked(self) -> Iterator[None]:
        """Books the processor time of a block. The clock is the thread's: waiting costs nothing."""
        began_s = time.thread_time()
        try:
            yield
        finally:
            self.spend(time.thread_time() - began_s)

    def spend(self, used_s: float) -> None:
        """Books processor time."""
        if self._is_on and self.owner is not None:
            budgets.spend(self.owner, used_s)

    def rest_s(self) -> float:
        """For how many seconds nothing more may be read from this connection."""
        return budgets.rest_s(self.owner) if self._is_on and self.owner is not None else 0.0

    def hold(self, size: int) -> bool:
        """Counts bytes of a message that is not whole yet; False if its owner has too many of them."""
        if not self._is_on or self.owner is None:
            return True
        self._held += size
        _unfinished[self.owner] += size
        return _unfinished[self.owner] <= MOST_UNFINISHED

    def release(self) -> None:
        """The message is whole, or will never be."""
        if self.owner is None or not self._held:
            return
        _unfinished[self.owner] -= self._held
        self._held = 0
        if not _unfinished[self.owner]:
            del _unfinished[self.owner]

    def belong_to(self, owner: str) -> None:
        """Books for this owner from now on."""
        self.release()
        self.owner = owner


def known(scope: Any, owner: str) -> None:
    """Books the connection of a request or a socket for its owner from now on."""
    costs = scope.get(COSTS)
    if costs is not None:
        costs.belong_to(owner)
