"""The deliberate differences from BehaviorTree.CPP, and the way to recognise them in a run.

A case whose differences have such a reason does not fail; its outcome has the name of the reason.
"""

from typing import Final

from tree_gardener.blackboard import Blackboard, Entry
from tree_gardener.values import ValueType

DEVIATIONS: Final = {
    "global-through-remap": (
        'an entry that is made through a remap to a global (x="{@g}") is the global here; '
        "BehaviorTree.CPP 4.10 makes one that is literally named '@g', and what is written there is lost"
    ),
}


class WatchedBlackboard(Blackboard):
    """A blackboard that records the deviations that occur in a run."""

    __slots__ = ("deviations",)

    def __init__(self, parent: Blackboard | None = None) -> None:
        super().__init__(parent)
        self.deviations: set[str] = parent.deviations if isinstance(parent, WatchedBlackboard) else set()

    def create(self, key: str, kind: ValueType | None) -> Entry:
        """Declares an entry, and records if a remapping leads to a global entry."""
        if _leads_to_global(self, key):
            self.deviations.add("global-through-remap")
        return super().create(key, kind)


def _leads_to_global(board: Blackboard, key: str) -> bool:
    while board.parent is not None and key[:1] != "@" and key not in board.entries:
        outer = board.remapping.get(key)
        if outer is None and (not board.autoremap or key[:1] == "_"):
            return False
        board, key = board.parent, key if outer is None else outer
        if key[:1] == "@":
            return True
    return False
