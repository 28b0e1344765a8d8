"""The loops over a queue."""

from __future__ import annotations

import collections

import pytest

from tests.tree_gardener.trees import letters, load
from tree_gardener import TickError
from tree_gardener.decorators.loop import Loop
from tree_gardener.registry import BUILT_IN


def test_the_child_is_ticked_once_for_each_element() -> None:
    tree = load("<LoopInt queue='1;2' value='{x}'><Script code='sum := x'/></LoopInt>")
    assert letters(tree, 3) == "RRS"
    assert tree.blackboard["sum"] == 2
    assert BUILT_IN["LoopInt"] is Loop


def test_a_deque_on_the_blackboard_is_consumed() -> None:
    tree = load("<LoopInt queue='{q}' if_empty='FAILURE'><Succeeding/></LoopInt>")
    tree.blackboard["q"] = queue = collections.deque([1])
    assert letters(tree, 2) == "RF"
    assert not queue


def test_a_queue_without_a_value_is_an_error() -> None:
    with pytest.raises(TickError, match="the entry 'q' has no value"):
        load("<LoopInt queue='{q}'><Succeeding/></LoopInt>").tick_exactly_once()
