"""Precondition."""

from __future__ import annotations

import pytest
from py_trees.common import Status

from tests.tree_gardener.trees import letters, load, recording
from tree_gardener import TickError
from tree_gardener.decorators.precondition import Precondition

NAME = Precondition.__name__


@pytest.mark.parametrize(("otherwise", "result"), [("SUCCESS", "S"), ("SKIPPED", "K"), ("RUNNING", "R")])
def test_a_false_script_gives_the_other_result(otherwise: str, result: str) -> None:
    assert letters(load(f"<{NAME} if='false' else='{otherwise}'><Failing/></{NAME}>"), 1) == result


def test_once_true_it_is_not_evaluated_until_the_child_is_done() -> None:
    nodes = {"A": recording(Status.RUNNING, Status.SUCCESS)}
    tree = load(f"<{NAME} if='x' else='FAILURE'><A/></{NAME}>", nodes=nodes)
    tree.blackboard["x"] = 1
    assert letters(tree, 1) == "R"
    tree.blackboard["x"] = 0
    assert letters(tree, 2) == "SF"


def test_a_script_that_fails_is_an_error_with_its_text() -> None:
    with pytest.raises(TickError, match="in the script 'nothing'"):
        load(f"<{NAME} if='nothing' else='FAILURE'><Failing/></{NAME}>").tick_exactly_once()
