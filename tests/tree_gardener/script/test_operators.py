"""Operators on single values; whole scripts are in `test_evaluator`."""

from __future__ import annotations

import math

import pytest

from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.errors import ScriptError
from tree_gardener.script import parse
from tree_gardener.script.environment import Environment
from tree_gardener.script.operators import EXACT, TOLERANCE, combine, compared, decision, prefixed, real
from tree_gardener.script.syntax import Binary, Comparison, Conditional, Unary

ENVIRONMENT = Environment(Blackboard(), {"RED": 5})


def statement(text: str) -> object:
    return parse(text).statements[0]


@pytest.mark.parametrize(
    ("symbol", "left", "right", "result"),
    [("+", 1, 2, 3.0), ("+", "a", "b", "ab"), ("..", "a", 2, "a2"), ("/", 1, 0, math.inf), ("|", 4, 1, 5.0)],
)
def test_a_binary_operator(symbol: str, left: object, right: object, result: object) -> None:
    expression = statement(f"a {symbol} b")
    assert isinstance(expression, Binary)
    assert combine(expression, left, right) == result


def test_prefixes() -> None:
    results = []
    for text in ("-a", "!a", "~a"):
        expression = statement(text)
        assert isinstance(expression, Unary)
        results.append(prefixed(expression, 0))
    assert results == [0.0, 1.0, -1.0]


def test_a_text_is_compared_as_the_constant_that_it_names() -> None:
    expression = statement("a == b")
    assert isinstance(expression, Comparison)
    assert compared(ENVIRONMENT, expression, "==", "RED", 5)
    assert compared(ENVIRONMENT, expression, "==", 1.0, 1.0 + TOLERANCE / 2)
    assert not compared(ENVIRONMENT, expression, "==", "true", 0)


def test_an_entry_without_a_value_decides_nothing() -> None:
    expression = statement("a ? 1 : 2")
    assert isinstance(expression, Conditional)
    with pytest.raises(ScriptError, match="a number is needed, not an entry without a value"):
        decision(expression, EMPTY)


def test_integers_that_no_double_holds_are_refused() -> None:
    assert real(EXACT - 1, (0, 1)) == EXACT - 1
    with pytest.raises(ScriptError, match="too large to compute with"):
        real(EXACT, (0, 1))
