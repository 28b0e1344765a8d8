"""Replaces a running tree by a changed one, which continues where the old one was.

`Swap` compares the two trees, says what stays, and makes the exchange. `capture` and `adopt` are its halves:
the state of a tree as data, and a tree that takes a state over.
"""

from tree_gardener.swap.adoption import adopt
from tree_gardener.swap.capturing import capture
from tree_gardener.swap.plan import Conflict, LatePort, Plan
from tree_gardener.swap.state import EntryState, Key, NodeState, TreeState
from tree_gardener.swap.swap import Swap, SwapRefusedError

__all__ = [
    "Conflict",
    "EntryState",
    "Key",
    "LatePort",
    "NodeState",
    "Plan",
    "Swap",
    "SwapRefusedError",
    "TreeState",
    "adopt",
    "capture",
]
