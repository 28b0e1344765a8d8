"""Conditions among the types of a tree."""

from __future__ import annotations

import pytest

from backend.projects.storage.conditions import action_paths, all_paths, conditions

TREE = {"nodes": {"n1": {"type": "Sequence"}, "n2": {"type": "IsNear"}, "n3": {"type": "Turn"}, "n4": 3}}
FILES = {
    "actions/IsNear.py": b'class IsNear(Behaviour):\n    NODE_KIND = "Condition"\n',
    "actions/Turn.py": b'# NODE_KIND = "Condition"\nclass Turn(Behaviour):\n    NODE_KIND = "Action"\n',
}


def test_the_class_says_that_it_is_a_condition():
    assert conditions(TREE, FILES.get) == ["IsNear"]


@pytest.mark.parametrize("line", [b"    NODE_KIND: str = 'Condition'", b'\tNODE_KIND="Condition"  # asks'])
def test_the_line_may_be_written_in_any_way(line):
    assert conditions(TREE, {"actions/IsNear.py": b"class IsNear:\n" + line}.get) == ["IsNear"]


@pytest.mark.parametrize("tree", [None, {}, {"nodes": 3}, {"nodes": {"n1": {"type": "../secret"}}}])
def test_a_tree_that_cannot_be_read_has_none(tree):
    assert action_paths(tree) == {}
    assert conditions(tree, FILES.get) == []


def test_the_files_of_many_trees_are_read_at_once():
    assert all_paths([TREE, {"nodes": {"a": {"type": "Turn"}}}]) == {
        "actions/Sequence.py",
        "actions/IsNear.py",
        "actions/Turn.py",
    }
