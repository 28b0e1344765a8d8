"""Measures the time of each node in ticks, while a caller wants it."""

import time
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, NamedTuple

from tree_gardener.node import Execute, Node
from tree_gardener.status import Status

if TYPE_CHECKING:
    from tree_gardener.tree import Tree


class NodeTime(NamedTuple):
    """The time of one node in some ticks.

    Attributes:
        uid: the node.
        calls: how often it was ticked.
        total_s: the time of these ticks, with that of the nodes below it.
        self_s: the same without the nodes below it: its rule and its conditions, or the action of a leaf.
    """

    uid: int
    calls: int
    total_s: float
    self_s: float


class Profile:
    """The times of the nodes of a tree, from when `Tree.profile` attaches it until that is called with None.

    Attach and detach it between two ticks. Generated code does not run meanwhile, so ticks are slower, and
    each time has some of the cost of the measurement in it. A halt belongs to the node that halts.

    Args:
        tree: the tree.
        clock: real time in s.
    """

    def __init__(self, tree: "Tree", clock: Callable[[], float] = time.perf_counter) -> None:
        self._clock = clock
        self._calls = [0] * len(tree.nodes)
        self._total_s = [0.0] * len(tree.nodes)
        self._self_s = [0.0] * len(tree.nodes)
        self._below_s = 0.0
        self._left_out_s = 0.0

    def leave_out(self, duration_s: float) -> None:
        """Takes a time that has just passed within a tick out of it, such as that of a debugger's hold."""
        self._left_out_s += duration_s

    def entry(self, node: Node, inner: Execute) -> Execute:
        """Returns the function that ticks a node and measures it."""
        at, clock = node.uid - 1, self._clock
        calls, total_s, self_s = self._calls, self._total_s, self._self_s

        def execute() -> Status:
            outer_s, self._below_s = self._below_s, 0.0
            start_s = clock() - self._left_out_s
            try:
                return inner()
            finally:
                duration_s = clock() - self._left_out_s - start_s
                calls[at] += 1
                total_s[at] += duration_s
                self_s[at] += duration_s - self._below_s
                self._below_s = outer_s + duration_s

        return execute

    def take(self) -> list[NodeTime]:
        """Returns the times since the last call, of the nodes that were ticked; call it between two ticks."""
        calls, totals, selves = self._calls, self._total_s, self._self_s
        taken = [NodeTime(at + 1, calls[at], totals[at], selves[at]) for at in range(len(calls)) if calls[at]]
        for time_ in taken:
            at = time_.uid - 1
            calls[at], totals[at], selves[at] = 0, 0.0, 0.0
        self._below_s = 0.0
        return taken


class Sums:
    """Adds up what was taken from a `Profile`."""

    def __init__(self) -> None:
        self._sums: dict[int, NodeTime] = {}

    def add(self, times: Iterable[NodeTime]) -> None:
        """Adds the times of further ticks."""
        for each in times:
            uid, calls, total_s, self_s = self._sums.get(each.uid, NodeTime(each.uid, 0, 0.0, 0.0))
            self._sums[uid] = NodeTime(uid, calls + each.calls, total_s + each.total_s, self_s + each.self_s)

    @property
    def nodes(self) -> list[NodeTime]:
        """The sum of each node that was ticked, in pre-order."""
        return [self._sums[uid] for uid in sorted(self._sums)]
