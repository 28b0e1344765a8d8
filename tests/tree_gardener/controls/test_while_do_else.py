"""WhileDoElse."""

from __future__ import annotations

from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener.controls.while_do_else import WhileDoElse

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE
NAME = WhileDoElse.__name__


def test_the_other_branch_is_halted_when_the_condition_changes() -> None:
    nodes = {"A": recording(S, F, kind="Condition"), "B": recording(R), "C": recording(S)}
    tree = load(f"<{NAME}><A/><B name='b'/><C/></{NAME}>", nodes=nodes)
    assert letters(tree, 2) == "RS"
    assert leaf(tree, "b").calls[-1] == "terminate INVALID from RUNNING"


def test_without_a_third_child_it_fails() -> None:
    assert letters(load(f"<{NAME}><Failing/><Succeeding/></{NAME}>"), 1) == "F"
