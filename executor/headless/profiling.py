"""The profile of a run in the terminal: measured in lock-step, and written as a table."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from executor.headless.report import ProfileRow
from tree_gardener.profiling import Profile, Sums

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from tree_gardener import Tree
    from tree_gardener.profiling import NodeTime

    Record = Callable[[int, Sequence[NodeTime]], None]

__all__ = ["MOST_LINES", "RunProfile", "lines_of"]

EVERY_S: Final = 0.5
MOST_LINES: Final = 20


class RunProfile:
    """Measures the nodes of a tree from now on.

    Args:
        tree: the tree.
        record: is called twice in a simulated second with a number of ticks and the times of the nodes in
            them; None where nothing is recorded.
    """

    def __init__(self, tree: Tree, record: Record | None) -> None:
        self._tree = tree
        self._record = record
        self._profile = Profile(tree)
        self._sums = Sums()
        self._from_tick = tree.tick_number
        self._due_s = EVERY_S
        tree.profile(self._profile)

    def look(self, now_s: float) -> None:
        """Takes the times, if this is due; called between two ticks."""
        if now_s >= self._due_s:
            self._due_s = now_s + EVERY_S
            self._take()

    def end(self) -> list[ProfileRow]:
        """Ends it; returns the times of the nodes that were ticked, in pre-order."""
        self._tree.profile(None)
        self._take()
        nodes = self._tree.nodes
        return [
            ProfileRow(nodes[each.uid - 1].path, each.calls, each.total_s * 1000.0, each.self_s * 1000.0)
            for each in self._sums.nodes
        ]

    def _take(self) -> None:
        ticks, self._from_tick = self._tree.tick_number - self._from_tick, self._tree.tick_number
        times = self._profile.take()
        self._sums.add(times)
        if times and self._record is not None:
            self._record(ticks, times)


def lines_of(rows: Sequence[ProfileRow]) -> Iterator[str]:
    """Yields a table of the nodes that took most time of their own, at most `MOST_LINES`."""
    if not rows:
        yield "No node was ticked, so there are no times."
        return
    whole_ms = sum(row.self_ms for row in rows)
    slowest = sorted(rows, key=lambda row: -row.self_ms)
    shown = slowest[:MOST_LINES]
    width = max(len("node"), *(len(row.path) for row in shown))
    yield (
        f"{'node':{width}}  {'share':>6}  {'self ms':>10}  {'with children':>13}  {'ticks':>8}"
        f"  {'self µs a tick':>14}"
    )
    for row in shown:
        share = row.self_ms / whole_ms if whole_ms > 0 else 0.0
        yield (
            f"{row.path:{width}}  {share:6.1%}  {row.self_ms:10.2f}  {row.total_ms:13.2f}  {row.calls:8}"
            f"  {row.self_ms / max(1, row.calls) * 1000.0:14.1f}"
        )
    if len(slowest) > len(shown):
        rest_ms = sum(row.self_ms for row in slowest[MOST_LINES:])
        yield f"and {len(slowest) - len(shown)} more nodes with {rest_ms:.2f} ms of their own"
