"""The names of types in messages."""

from __future__ import annotations

import contextlib

import pytest

from tree_gardener.type_words import type_words
from tree_gardener.values import BY_NAME, ConversionError, value_words


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("double", "a number"),
        ("list[int]", "a list, each a whole number"),
        ("Spot", "a value of type Spot"),
    ],
)
def test_a_type_has_words(name: str, words: str) -> None:
    assert type_words(name) == words


def test_no_value_is_refused_by_a_name_of_cpp() -> None:
    for kind in ("int", "uint", "int64", "double", "bool", "list[double]"):
        for value in ("what", 2.5, object(), [object()], 1e300):
            with contextlib.suppress(ConversionError):
                BY_NAME[kind].convert(value)
                continue
            with pytest.raises(ConversionError) as refused:
                BY_NAME[kind].convert(value)
            assert not {"int", "uint", "int64", "double", "string", "integer"} & set(
                str(refused.value).split()
            )


def test_a_value_is_named_by_its_type() -> None:
    assert [value_words(each) for each in (True, 1, 1.5, "x", [1])] == [
        "true or false",
        "a whole number",
        "a number",
        "a text",
        "a value of type list",
    ]
