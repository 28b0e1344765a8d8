"""IfThenElse."""

from __future__ import annotations

import pytest
from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener import TickError
from tree_gardener.controls.if_then_else import IfThenElse

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE
NAME = IfThenElse.__name__


@pytest.mark.parametrize(("condition", "result"), [("Succeeding", "S"), ("Failing", "F")])
def test_the_condition_chooses(condition: str, result: str) -> None:
    assert letters(load(f"<{NAME}><{condition}/><Succeeding/><Failing/></{NAME}>"), 1) == result


def test_the_choice_holds_while_it_runs() -> None:
    nodes = {"A": recording(S, F), "B": recording(R, S)}
    tree = load(f"<{NAME}><A name='a'/><B/><Failing/></{NAME}>", nodes=nodes)
    assert letters(tree, 2) == "RS"
    assert leaf(tree, "a").calls.count("update") == 1


@pytest.mark.parametrize(
    ("children", "message"),
    [("<Succeeding/>", "needs 2 or 3 children"), ("<Succeeding _skipIf='true'/><Failing/>", "was skipped")],
)
def test_what_it_cannot_do_is_an_error(children: str, message: str) -> None:
    with pytest.raises(TickError, match=message):
        load(f"<{NAME}>{children}</{NAME}>").tick_exactly_once()
