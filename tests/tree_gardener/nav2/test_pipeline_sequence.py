"""PipelineSequence as a project's own control node."""

from __future__ import annotations

from tests.tree_gardener.nav2_trees import nav2_tree, ticks
from tree_gardener.nav2.pipeline_sequence import PipelineSequence


def test_earlier_children_are_ticked_again_while_a_later_one_runs() -> None:
    tree = nav2_tree(PipelineSequence, ["S", "RRS"])
    assert ticks(tree, 3) == "RRS"
    assert [node.status.letter for node in tree.nodes] == ["I", "I", "I"]


def test_a_failure_ends_it() -> None:
    assert ticks(nav2_tree(PipelineSequence, ["S", "F"]), 1) == "F"
