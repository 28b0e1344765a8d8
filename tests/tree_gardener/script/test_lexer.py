"""A script as tokens."""

from __future__ import annotations

import pytest

from tree_gardener.errors import ScriptError
from tree_gardener.script.lexer import tokenize


def test_every_kind_of_token_has_its_place() -> None:
    tokens = tokenize("@a := 0x1F .. 'b c' + 1.5e3")
    assert [(token.kind, token.text) for token in tokens] == [
        ("name", "@a"),
        ("operator", ":="),
        ("integer", "0x1F"),
        ("operator", ".."),
        ("string", "'b c'"),
        ("operator", "+"),
        ("real", "1.5e3"),
        ("end", ""),
    ]
    assert [(token.start, token.end) for token in tokens[:2]] == [(0, 2), (3, 5)]


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ('"x"', "single quotes"),
        ("5 % 2", "no remainder"),
        ("3foo", "numbers are"),
    ],
)
def test_what_is_no_token_is_refused_with_a_hint(text: str, hint: str) -> None:
    with pytest.raises(ScriptError) as refused:
        tokenize(text)
    assert hint in refused.value.hint
