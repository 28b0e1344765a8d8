"""Charges the event-loop time of each connection to its owner.

Reading pauses for owners who exceed their share.

Heads, frames and refused connections need no request thread, but they take time of the event loop, for which
all connections wait.
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
"""The key of the `ConnectionCosts` in the scope of a request or a socket."""
MOST_UNFINISHED: Final = 128 << 20
"""Bytes of incomplete messages on all sockets of one owner: twice the largest message."""
_unfinished: Final[Counter[str]] = Counter()


class ConnectionCosts:
    """The costs of one connection, and the owner who pays them.

    Args:
        address: the address of the other end.

    Attributes:
        owner: the owner who pays: the address until the user is known. If the address is that of a proxy, no
            owner pays.
    """

    def __init__(self, address: str | None) -> None:
        settings = environment()
        self._is_on = settings.is_team
        self.owner = None if settings.proxy_hops else stranger(address_of(address, {}))
        self._held = 0

    @contextmanager
    def booked(self) -> Iterator[None]:
        """Charges the processor time of the block to the owner.

        The clock is that of the thread, so waiting costs nothing.
        """
        began_s = time.thread_time()
        try:
            yield
        finally:
            self.spend(time.thread_time() - began_s)

    def spend(self, used_s: float) -> None:
        """Charges processor time to the owner."""
        if self._is_on and self.owner is not None:
            budgets.spend(self.owner, used_s)

    def rest_s(self) -> float:
        """Returns the number of seconds for which this connection must not be read."""
        return budgets.rest_s(self.owner) if self._is_on and self.owner is not None else 0.0

    def hold(self, size: int) -> bool:
        """Counts bytes of an incomplete message; returns False if the owner holds too many of them."""
        if not self._is_on or self.owner is None:
            return True
        self._held += size
        _unfinished[self.owner] += size
        return _unfinished[self.owner] <= MOST_UNFINISHED

    def release(self) -> None:
        """Releases the counted bytes, since the message is complete or will never be complete."""
        if self.owner is None or not self._held:
            return
        _unfinished[self.owner] -= self._held
        self._held = 0
        if not _unfinished[self.owner]:
            del _unfinished[self.owner]

    def belong_to(self, owner: str) -> None:
        """Sets the owner to whom later costs are charged."""
        self.release()
        self.owner = owner


def known(scope: Any, owner: str) -> None:
    """Sets the owner to whom later costs of a connection are charged.

    `scope` is that of its request or socket.
    """
    costs = scope.get(COSTS)
    if costs is not None:
        costs.belong_to(owner)
