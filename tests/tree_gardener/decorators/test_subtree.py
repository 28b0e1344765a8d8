"""SubTree."""

from __future__ import annotations

from tests.tree_gardener.trees import letters, load, subtree
from tree_gardener.decorators.subtree import SubTree


def test_names_are_connected_in_both_directions() -> None:
    tree = load(
        "<Sequence><Script code='a := 1'/><SubTree ID='In' x='{a}' y='{b}'/></Sequence>",
        subtree("In", "<Script code='y := x + 1; z := 5'/>"),
    )
    assert letters(tree, 1) == "S"
    assert tree.blackboard["b"] == 2
    assert "z" not in tree.blackboard


def test_its_path_is_its_name_or_its_tree_with_its_number() -> None:
    inner = subtree("In", "<Succeeding/>")
    tree = load("<Sequence><SubTree ID='In' name='left'/><SubTree ID='In'/></Sequence>", inner)
    calls = [node for node in tree.nodes if isinstance(node, SubTree)]
    assert [node.local_path for node in calls] == ["left", f"In::{calls[1].uid}"]


def test_a_skipped_tree_makes_it_skipped() -> None:
    assert letters(load("<SubTree ID='In'/>", subtree("In", "<Failing _skipIf='true'/>")), 1) == "K"
