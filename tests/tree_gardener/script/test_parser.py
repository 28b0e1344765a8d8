"""Scripts that are read, or refused with the place."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tree_gardener.errors import ScriptError
from tree_gardener.script import parse


@pytest.mark.parametrize(
    ("text", "span", "message"),
    [
        ("x := ", (5, 5), "a value is expected at the end"),
        ("x := 3foo", (5, 9), "'3foo' is not a number"),
        ("x := 5 % 2", (7, 8), "'%' has no meaning"),
        ("x := (1", (7, 7), "')' is missing"),
        ("x ? 1", (5, 5), "':' is missing"),
        ("x == == 1", (5, 7), "a value is expected before '=='"),
        ("'open", (0, 1), "has no meaning"),
        ("", (0, 0), "empty"),
        ("(" * 300, (251, 252), "nested too deeply"),
        ("-" * 300 + "1", (300, 301), "nested too deeply"),
    ],
)
def test_errors_of_syntax_have_a_span(text: str, span: tuple[int, int], message: str) -> None:
    with pytest.raises(ScriptError) as refused:
        parse(text)
    assert refused.value.span == span
    assert message in refused.value.message


@given(st.text(alphabet="ab1.'()+-*/&|^=<>!~?:;@ \n%", max_size=30))
@settings(max_examples=300)
def test_any_text_parses_or_is_refused_inside_of_it(text: str) -> None:
    try:
        program = parse(text)
    except ScriptError as error:
        start, end = error.span
        assert 0 <= start <= end <= len(text)
    else:
        for statement in program.statements:
            assert 0 <= statement.span[0] < statement.span[1] <= len(text)
