"""NonblockingSequence as a project's own control node."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_trees import nav2_tree, ticks
from tree_gardener import TickError
from tree_gardener.nav2.nonblocking_sequence import NonblockingSequence


def test_all_children_are_ticked_until_all_succeed() -> None:
    assert ticks(nav2_tree(NonblockingSequence, ["RRS", "S"]), 3) == "RRS"
    assert ticks(nav2_tree(NonblockingSequence, ["R", "F"]), 1) == "F"


def test_a_skipped_child_is_an_error() -> None:
    with pytest.raises(TickError, match="child 1 was skipped"):
        nav2_tree(NonblockingSequence, ["S", "K"]).tick_exactly_once()
