"""RoundRobin as a project's own control node."""

from __future__ import annotations

from tests.tree_gardener.nav2_trees import nav2_tree, ticks
from tree_gardener.nav2.round_robin import RoundRobin


def test_each_success_hands_over_to_the_next_child() -> None:
    tree = nav2_tree(RoundRobin, ["S", "S"], 'wrap_around="true"')
    assert ticks(tree, 3) == "SSS"
    calls = [node.behaviour.calls.count("update") for node in tree.nodes[1:]]
    assert calls == [2, 1]


def test_all_skipped_is_skipped_and_idle() -> None:
    tree = nav2_tree(RoundRobin, ["K", "K"])
    assert ticks(tree, 1) == "K"
    assert tree.nodes[0].status.letter == "I"
