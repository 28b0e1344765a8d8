"""Stores the statuses of the last tick, and finds the node that decided the result of the tree."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tree_gardener import Status

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tree_gardener import TickChanges
    from tree_gardener.node import Node

__all__ = ["LastTick"]


class LastTick:
    """The statuses of nodes in the last tick, after they became IDLE again.

    A node becomes IDLE when its parent resets it within the tick, or when the tree is halted after the tick.
    The report of such a halt has the number of the tick before it, and is added to the statuses of that tick.

    Attributes:
        past: the last status of each node that is IDLE now, by the node's uid.
    """

    def __init__(self) -> None:
        self.past: dict[int, Status] = {}
        self._tick = 0
        self._statuses: dict[int, Status] = {}
        self._results: dict[int, Status] = {}

    def take(self, changes: TickChanges) -> bool:
        """Adds the report of a tick or of a halt; returns whether `past` changed."""
        before = self.past
        past = dict(before) if changes.tick == self._tick else {}
        if changes.tick != self._tick:
            self._tick, self._results = changes.tick, {}
        for uid, status in changes.changed:
            if status is Status.IDLE:
                past.setdefault(uid, self._statuses.pop(uid, Status.IDLE))
            else:
                self._statuses[uid] = self._results[uid] = status
        # A result is later than the status that the node had when the tick began.
        past.update(changes.flashed)
        self._results.update(changes.flashed)
        self.past = {
            uid: status
            for uid, status in past.items()
            if status is not Status.IDLE and uid not in self._statuses
        }
        return self.past != before

    def decider(self, nodes: Sequence[Node], status: Status) -> Node:
        """Returns the lowest node that decided the status of the root.

        Args:
            nodes: the nodes of the tree, in pre-order.
            status: what the root returned in the last tick.
        """
        decider = nodes[0]
        while below := [n for n in nodes if n.parent is decider and self._results.get(n.uid) is status]:
            decider = below[-1]
        return decider
