"""PersistentSequence as a project's own control node."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_trees import nav2_tree, ticks
from tree_gardener import TickError
from tree_gardener.nav2.persistent_sequence import PersistentSequence


def test_its_position_is_on_the_blackboard_and_survives_a_halt() -> None:
    tree = nav2_tree(PersistentSequence, ["S", "RS"], 'current_child_idx="{at}"')
    tree.blackboard["at"] = 0
    assert ticks(tree, 1) == "R"
    tree.halt()
    assert tree.blackboard["at"] == 1
    assert ticks(tree, 1) == "S"
    assert tree.blackboard["at"] == 0


def test_a_position_without_a_value_is_an_error_before_it_runs() -> None:
    tree = nav2_tree(PersistentSequence, ["S"], 'current_child_idx="{at}"')
    with pytest.raises(TickError, match="'at' has no value"):
        tree.tick_exactly_once()
    assert tree.nodes[0].status.letter == "I"
    tree.blackboard["at"] = -1
    with pytest.raises(TickError, match="has no child -1"):
        tree.tick_exactly_once()
