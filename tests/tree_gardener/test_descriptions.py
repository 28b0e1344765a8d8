"""Texts of any value and any exception are short and readable, and never end the run."""

from __future__ import annotations

import contextlib
import io
import sys
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.fakes.hostile_values import VALUES, Endless, Pose, Raises, errors
from tree_gardener.descriptions import (
    LONGEST,
    LONGEST_ERROR,
    LONGEST_TRACEBACK,
    as_text,
    error_text,
    text_of,
    traceback_text,
)
from tree_gardener.errors import describe
from tree_gardener.values import as_number, to_text, type_name_of

PLANS = st.recursive(
    st.integers(0, len(VALUES) - 1),
    lambda inner: st.tuples(st.sampled_from("ltdp"), inner, inner),
    max_leaves=6,
)
"""How values are put together; pytest and Hypothesis themselves fail at some of the values."""


def built(plan: Any) -> Any:
    if isinstance(plan, int):
        return VALUES[plan]
    kind, one, two = plan[0], built(plan[1]), built(plan[2])
    return {"l": [one, two], "t": (one, two), "d": {"a": one, "b": two}, "p": Pose(one, [two])}[kind]


def is_fine(text: str, longest: int) -> bool:
    text.encode()
    return type(text) is str and len(text) <= longest


def raised(error: Exception) -> Exception:
    try:
        raise error
    except Exception as caught:
        return caught


@given(PLANS)
def test_any_value_has_short_texts(plan: Any) -> None:
    value, before = built(plan), sys.gettrace()
    with contextlib.redirect_stdout(io.StringIO()):
        assert is_fine(text_of(value), LONGEST)
        assert is_fine(as_text(value), LONGEST)
        assert is_fine(type_name_of(value), LONGEST)
    assert sys.gettrace() is before


@pytest.mark.parametrize("number", range(len(VALUES)))
def test_each_value_alone(number: int) -> None:
    value = VALUES[number]
    with contextlib.redirect_stdout(io.StringIO()):
        assert is_fine(text_of(value), LONGEST)
        assert is_fine(as_text(value), LONGEST)
    type_name_of(value)
    with contextlib.suppress(ValueError, TypeError):  # what its own methods may raise
        as_number(value)
        to_text(value)


@pytest.mark.parametrize("number", range(len(errors())))
def test_any_exception_has_a_text_and_a_traceback(number: int) -> None:
    caught = raised(errors()[number])
    assert is_fine(error_text(caught), LONGEST_ERROR)
    assert is_fine(describe(caught), LONGEST_ERROR + 100)
    assert is_fine(traceback_text(caught), LONGEST_TRACEBACK + 10)
    assert "test_descriptions.py" in traceback_text(caught)


def test_texts_say_what_is_wrong_with_a_value() -> None:
    assert text_of(Raises()) == "<Raises; its repr raised SystemExit>"
    assert text_of(Endless()) == "<Endless; its repr does not end>"
    assert text_of([1, "a", {"b": (2.5,)}]) == "[1, 'a', {'b': (2.5,)}]"
    assert text_of(Pose(1.0, [2])) == "Pose(x=1.0, parts=[2])"
    assert text_of({3, 1, 2}) == "{1, 2, 3}"
    assert text_of(set()) == "set()"
    assert text_of(object()) == "<builtins.object object>"
    assert as_text("a") == "a"
    assert error_text(ValueError("no")) == "no"


def test_ctrl_c_in_a_repr_ends_the_run() -> None:
    class Stops:
        def __repr__(self) -> str:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        text_of(Stops())
