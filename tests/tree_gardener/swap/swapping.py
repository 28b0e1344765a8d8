"""Runs a random tree that is replaced between ticks by an equal one, as if nothing had happened."""

from __future__ import annotations

import random
from typing import TYPE_CHECKING, Any

from tests.tree_gardener.fuzz.generate import KEYS
from tests.tree_gardener.generated.both_ways import Run
from tree_gardener import TickError, Tree
from tree_gardener.blackboard import Blackboard
from tree_gardener.clock import ManualClock
from tree_gardener.swap import Swap
from tree_gardener.values import INT

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.tree_gardener.fuzz.generate import Case

STEP_S = 0.007


class SwappedRun(Run):
    """One run of a case in which the tree is replaced now and then, with the probability `swaps`."""

    def __init__(self, case: Case, *, letters: str, swaps: float) -> None:
        self.clock = ManualClock()
        self.classes: dict[str, Any] | None = None
        self.swaps = swaps
        self.swapped = 0
        self.swap_chance = random.Random(case.seed + 1)  # noqa: S311 - a reproducible case, no secret
        super().__init__(case, is_generated=case.seed % 2 == 0, letters=letters, changes=False)
        self.tree.use_clock(self.clock)

    def nodes(self) -> dict[str, Any]:
        """The leaves; the same classes for each tree."""
        if self.classes is None:
            self.classes = super().nodes()
        return self.classes

    def tick(self, function: Callable[[], Any]) -> None:
        """Ticks or halts the tree, which may be replaced before."""
        if self.swap_chance.random() < self.swaps:
            self.replace()
            function = getattr(self.tree, function.__name__)
        self.clock.advance(STEP_S)
        super().tick(function)

    def replace(self) -> None:
        """Replaces the tree by an equal one."""
        board = Blackboard()
        for key in KEYS:
            board.set(key, 1, INT)
        fresh = Tree.from_xml(self.case.xml(), self.nodes(), ManualClock(), blackboard=board)
        fresh.generate_code(on=self.swap_chance.random() < 0.5)
        swap = Swap(self.tree, fresh)
        assert not swap.plan.halted
        assert not swap.plan.added
        self.tree = swap.run()
        self.board = self.tree.blackboard
        self.swapped += 1


def compare(case: Case, letters: str) -> int:
    """Compares a case with and without exchanges; returns the number of exchanges.

    Raises:
        AssertionError: the runs differ.
    """
    alone = SwappedRun(case, letters=letters, swaps=0.0)
    swapped = SwappedRun(case, letters=letters, swaps=0.5)
    expected, found = alone.run(), swapped.run()
    for index, (one, other) in enumerate(zip(expected, found, strict=False)):
        assert one == other, f"seed {case.seed}, entry {index}:\n{case.xml()}\nalone   {one}\nswapped {other}"
    assert len(expected) == len(found)
    return swapped.swapped


__all__ = ["SwappedRun", "TickError", "compare"]
