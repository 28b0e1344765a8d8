"""Assignments to single entries; whole scripts are in `test_evaluator`."""

from __future__ import annotations

import pytest

from tree_gardener.blackboard import Blackboard
from tree_gardener.errors import ScriptError
from tree_gardener.script import parse
from tree_gardener.script.assignments import assign, target_of
from tree_gardener.script.environment import Environment
from tree_gardener.script.syntax import Assignment


def assignment(text: str) -> Assignment:
    expression = parse(text).statements[0]
    assert isinstance(expression, Assignment)
    return expression


def test_an_entry_is_made_before_the_value_is_known() -> None:
    board = Blackboard()
    entry = target_of(Environment(board, {}), assignment("a := 1"))
    assert board.find("a") is entry
    with pytest.raises(ScriptError, match="create it with :="):
        target_of(Environment(board, {}), assignment("b = 1"))


@pytest.mark.parametrize(
    ("old", "symbol", "new", "result"),
    [(1, ":=", 2.0, 2), (True, ":=", 0.0, False), ("a", "+=", "b", "ab"), (1.5, "=", 2, 2.0)],
)
def test_a_value_takes_the_kind_of_its_entry(old: object, symbol: str, new: object, result: object) -> None:
    board = Blackboard()
    entry = board.create("a", None)
    entry.write(old)
    stored = assign(Environment(board, {}, 7), assignment(f"a {symbol} 1"), entry, new)
    assert (stored, type(stored)) == (result, type(result))
    assert entry.value == result
