"""Delays the requests of owners who exceeded their share; these requests then start one after the other."""

from __future__ import annotations

import asyncio
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Final

from backend.config.environment import environment
from backend.core.processes.budgets import budgets

if TYPE_CHECKING:
    from collections.abc import AsyncIterator

    from backend.core.processes.budgets import Budgets


class Turns:
    """Decides when requests may start. On a server with one user, all requests start immediately.

    Args:
        budgets: the processor time that owners have used.
    """

    def __init__(self, budgets: Budgets) -> None:
        self._budgets = budgets
        self._queues: dict[str, _Queue] = {}

    @asynccontextmanager
    async def turn(self, owner: str) -> AsyncIterator[None]:
        """Waits until the owner may continue. An owner who exceeded their share has one request at a time."""
        if not environment().is_team or (owner not in self._queues and not self._budgets.rest_s(owner)):
            yield
            return
        queue = self._queues.setdefault(owner, _Queue())
        queue.waiting += 1
        try:
            async with queue.lock:
                # It sleeps only once: frames of the same owner could extend the time without end.
                await asyncio.sleep(self._budgets.rest_s(owner))
                yield
        finally:
            queue.waiting -= 1
            if not queue.waiting:
                del self._queues[owner]

    async def rest(self, owner: str) -> None:
        """Waits for as long as the owner must wait; other owners continue."""
        if environment().is_team and (rest_s := self._budgets.rest_s(owner)):
            await asyncio.sleep(rest_s)

    def spend(self, owner: str, used_s: float) -> None:
        """Charges processor time, in seconds, to an owner."""
        if environment().is_team:
            self._budgets.spend(owner, used_s)


class _Queue:
    def __init__(self) -> None:
        self.lock = asyncio.Lock()
        self.waiting = 0


turns: Final = Turns(budgets)
"""The turns of this process, for requests and for sockets."""
