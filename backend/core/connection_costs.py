"""Charges the event-loop time of each connection to its owner.

Reading pauses for owners who exceed their share.

Heads, frames and refused connections need no request thread, but they take time of the event loop, for which
all connections wait.
"""

from __future__ import annotations

import time
from collections import deque
from contextlib import contextmanager
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Final

from backend.config.environment import environment
from backend.core.clients import address_of, stranger
from backend.core.processes.budgets import budgets
from backend.core.processes.siblings import siblings
from backend.core.readers import Readers

if TYPE_CHECKING:
    from collections.abc import Iterator

    from backend.core.readers import Held

COSTS: Final = "bt_studio.connection_costs"
"""The key of the `ConnectionCosts` in the scope of a request or a socket."""
ABORT: Final = "bt_studio.abort"
"""The key of the function in the scope of a request that ends its connection at once."""
LARGEST_MESSAGE: Final = 64 << 20
LEAST_OF_OWNER: Final = LARGEST_MESSAGE + LARGEST_MESSAGE // 16
"""Bytes that an owner may hold however small the part of all is: the largest message with its frames."""


@lru_cache(maxsize=1)
def messages() -> Readers:
    """Returns the messages that this process holds until they are passed on.

    They have their own limit, so that no message refuses an answer, and no answer a message.
    """
    workers = siblings.family.size if siblings.family else 1
    return Readers(None, environment().max_unread_bytes // workers)


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
        self._arriving: Held | None = None
        self._whole: deque[Held | None] = deque()
        self._is_being_passed_on = False

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
        """Counts bytes of a message that arrives, until it is passed on.

        Returns False if there are too many of the owner's messages, or of all owners.
        """
        if not self._is_on or self.owner is None:
            return True
        if self._arriving is None:
            self._arriving = messages().of(self.owner)
        return self._arriving.grow(size, max(messages().most // 2, LEAST_OF_OWNER))

    @property
    def is_counted(self) -> bool:
        """Whether the messages of this connection count."""
        return self._is_on and self.owner is not None

    def nothing_arrives(self) -> None:
        """Releases what came between messages, as pings do."""
        if self._arriving is not None:
            self._arriving.close()
            self._arriving = None

    def complete(self) -> None:
        """Notes that the message that arrives is complete."""
        self._whole.append(self._arriving)
        self._arriving = None

    def taken(self) -> None:
        """Notes that the application has taken the oldest complete message."""
        self._is_being_passed_on = bool(self._whole)

    def passed_on(self) -> None:
        """Releases the bytes of the message that the application has taken: it asks for the next one."""
        if self._is_being_passed_on and (held := self._whole.popleft()) is not None:
            held.close()
        self._is_being_passed_on = False

    def release(self) -> None:
        """Releases all counted bytes, since no message will be passed on any more."""
        for held in (*self._whole, self._arriving):
            if held is not None:
                held.close()
        self._whole.clear()
        self._arriving, self._is_being_passed_on = None, False

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
