"""The script language: positions of errors, values, and properties, evaluated and compiled."""

from __future__ import annotations

import contextlib
import math
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.errors import ScriptError
from tree_gardener.script import Environment, bind_run, compile_script
from tree_gardener.values import ANY, BOOL, INT, STRING

if TYPE_CHECKING:
    from collections.abc import Callable


WAYS: dict[str, Callable[[str, Environment], Any]] = {
    "evaluated": lambda text, environment: compile_script(text).run(environment),
    "compiled": lambda text, environment: bind_run(text, environment)(),
}
_way = {"now": "evaluated"}


@pytest.fixture(params=WAYS, autouse=True, scope="module")
def way(request: pytest.FixtureRequest) -> None:
    """Runs each test with the evaluator and with compiled scripts."""
    _way["now"] = request.param


def run(text: str, board: Blackboard | None = None) -> Any:
    return WAYS[_way["now"]](text, Environment(board if board is not None else Blackboard(), {"RED": 5}))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nothing + 1", "there is no entry 'nothing'"),
        ("'a' - 1", "'-' does not work"),
        ("1.5 & 1", "whole numbers only"),
        ("'a' | 1", "does not work"),
        ("3 := 4", "only a blackboard entry"),
        ("x = 4", "create it with :="),
        ("'a' && 1", "does not work"),
        ("2 && 1", "neither 0 nor 1"),
        ("'a' ? 1 : 2", "not a number"),
        ("x := 1; x += 'a'", "does not work"),
        ("x := 'a'; x += 1", "needs a number"),
        ("x := 'a'; x := 1", "cannot be assigned"),
        ("x := 1; x := 1.5", "holds a whole number"),
        ("-'a'", "a number is needed"),
        ("@@x := 1", "has no meaning|'@'"),
    ],
)
def test_errors_of_evaluation_say_what(text: str, message: str) -> None:
    with pytest.raises(ScriptError, match=message):
        run(text)


def test_values_keep_the_kind_of_their_entry() -> None:
    board = Blackboard()
    board.set("typed", 1, INT)
    board.set("flag", True, BOOL)
    assert run("typed := '7'", board) == 7
    assert run("flag := 0", board) is False
    assert run("flag := 3", board) == 3
    board.unset("typed")
    board.create("typed", INT)
    with pytest.raises(ScriptError, match="holds a whole number"):
        run("typed := 'x'", board)


def test_objects_can_be_handed_on_but_not_computed_with() -> None:
    board = Blackboard()
    board["image"] = image = object()
    assert run("other := image", board) is image
    assert board["other"] is image
    assert run("other := 'text'", board) == "text"
    with pytest.raises(ScriptError):
        run("image + 1", board)


def test_two_numbers_joined_have_no_value() -> None:
    assert run("1 .. 2") is EMPTY


NUMBERS = st.one_of(
    st.integers(0, 2**31).map(str),
    st.floats(0, 1e6, allow_nan=False).map(lambda value: f"{value:.4f}"),
)


@st.composite
def arithmetic(draw: st.DrawFn, depth: int = 4) -> tuple[str, float]:
    """An expression with its value by Python's own arithmetic."""
    if depth == 0 or draw(st.booleans()):
        text = draw(NUMBERS)
        return text, float(text)
    symbol = draw(st.sampled_from("+-*/"))
    left, a = draw(arithmetic(depth - 1))
    right, b = draw(arithmetic(depth - 1))
    text = f"({left}) {symbol} ({right})"
    if symbol == "/":
        return text, a / b if b else math.nan if not a or math.isnan(a) else math.copysign(
            math.inf, a
        ) * math.copysign(1, b)
    return text, {"+": a + b, "-": a - b, "*": a * b}[symbol]


@given(arithmetic())
@settings(max_examples=150)
def test_arithmetic_is_that_of_doubles(case: tuple[str, float]) -> None:
    text, expected = case
    found = float(run(text))
    assert found == expected or (math.isnan(found) and math.isnan(expected))


@given(st.text(alphabet="ab1.'()+-*&=<>!?:; ", max_size=25))
@settings(max_examples=300)
def test_running_raises_nothing_but_script_errors(text: str) -> None:
    board = Blackboard()
    board["a"], board["b"] = 1, "text"
    with contextlib.suppress(ScriptError):
        run(text, board)


def test_an_entry_that_is_watched_takes_no_text_from_a_script() -> None:
    board = Blackboard()
    board.create("loose", ANY)
    board.create("text", STRING)
    assert run("loose := 1; text := 'y'", board) == "y"
    with pytest.raises(ScriptError, match="'loose' is watched"):
        run("loose := 'x'", board)
