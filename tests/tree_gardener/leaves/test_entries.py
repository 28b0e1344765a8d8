"""SetBlackboard, UnsetBlackboard and WasEntryUpdated."""

from __future__ import annotations

from tests.tree_gardener.trees import letters, load
from tree_gardener.leaves.entries import SetBlackboard, UnsetBlackboard, WasEntryUpdated


def test_a_literal_and_a_copy_are_written() -> None:
    name = SetBlackboard.__name__
    tree = load(
        f"<Sequence><{name} value='5' output_key='a'/><{name} value='{{x}}' output_key='b'/></Sequence>"
    )
    tree.blackboard["x"] = 7
    assert letters(tree, 1) == "S"
    assert (tree.blackboard["a"], tree.blackboard["b"]) == ("5", 7)


def test_a_source_without_a_value_fails() -> None:
    assert letters(load("<SetBlackboard value='{no}' output_key='b'/>"), 1) == "F"


def test_an_entry_is_removed_also_where_there_is_none() -> None:
    tree = load(f"<{UnsetBlackboard.__name__} key='a'/>")
    tree.blackboard["a"] = 1
    assert letters(tree, 2) == "SS"
    assert "a" not in tree.blackboard


def test_a_write_is_seen_once() -> None:
    tree = load(f"<{WasEntryUpdated.__name__} entry='{{a}}'/>")
    assert letters(tree, 1) == "F"
    tree.blackboard["a"] = 1
    assert letters(tree, 2) == "SF"
