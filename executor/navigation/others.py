"""Whether other nodes offer navigation, or are expected to: then a world offers none."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from rclpy.node import Node

__all__ = ["Others"]

JOIN_S: Final = 5.0
"""The real time for which nodes are expected to join the graph."""
SETTLE_S: Final = 1.0
"""The real time after they have joined in which they may make their servers."""


class Others:
    """Looks for other nodes that offer navigation.

    Args:
        services: the services of navigation; those of its actions are among them.
        topic: the topic of the map.
        clock: returns the real time in s.
    """

    def __init__(
        self, services: Sequence[str], topic: str, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._services = services
        self._topic = topic
        self._clock = clock
        self._expected: frozenset[str] = frozenset()
        self._until_s = 0.0
        self._joined_s: float | None = None

    def expect(self, names: Iterable[str]) -> None:
        """Expects nodes that have just been started and may offer navigation; replaces the last names."""
        self._expected = frozenset(names)
        self._until_s, self._joined_s = self._clock() + JOIN_S, None

    def are_expected(self, node: Node) -> bool:
        """Returns whether nodes are still expected, as `node` sees the graph."""
        now_s = self._clock()
        if self._expected and self._expected <= set(node.get_node_names()):
            self._joined_s = now_s if self._joined_s is None else self._joined_s
            self._until_s = min(self._until_s, self._joined_s + SETTLE_S)
        if now_s >= self._until_s:
            self._expected = frozenset()
        return bool(self._expected)

    def offer(self, node: Node, *, own: int) -> bool:
        """Returns whether others offer navigation; `own` is the number of our own servers of each name."""
        return node.count_publishers(self._topic) > own or any(
            node.count_services(name) > own for name in self._services
        )
