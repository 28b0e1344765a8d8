"""Books what a connection costs the event loop: who uses more than their share is read later.

Heads, frames and connections that are refused cost no request thread, but each takes the event loop, for
which everybody waits.
"""

from __future__ import annotations

import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

from backend.config.environment import environment
from backend.core.clients import address_of, stranger
from backend.core.processes.budgets import budgets

if TYPE_CHECKING:
    from collections.abc import Iterator

COSTS: Final = "bt_studio.connection_costs"
"""The `ConnectionCosts` in the scope of a request or a socket."""


class ConnectionCosts:
    """What one connection costs, and for whom.

    Args:
        address: the other end's.

    Attributes:
        owner: who pays. It is the address until more is known; where that is a proxy's, nobody.
    """

    def __init__(self, address: str | None) -> None:
        settings = environment()
        self._is_on = settings.is_team
        self.owner = None if settings.proxy_hops else stranger(address_of(address, {}))

    @contextmanager
    def booked(self) -> Iterator[None]:
        """Books the processor time of a block. The clock is the thread's: waiting costs nothing."""
        began_s = time.thread_time()
        try:
            yield
        finally:
            if self._is_on and self.owner is not None:
                budgets.spend(self.owner, time.thread_time() - began_s)

    def rest_s(self) -> float:
        """For how many seconds nothing more may be read from this connection."""
        return budgets.rest_s(self.owner) if self._is_on and self.owner is not None else 0.0


def known(scope: Any, owner: str) -> None:
    """Has the owner of a request or a socket pay for its connection from now on."""
    costs = scope.get(COSTS)
    if costs is not None:
        costs.owner = owner
