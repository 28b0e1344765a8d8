"""Values as Python source in lines of at most 99 characters, which mean the same."""

from __future__ import annotations

import ast

import pytest

from translator.package.literal import WIDTH, python_literal


@pytest.mark.parametrize(
    "value",
    [
        "short",
        5.0,
        ["a", "b"],
        "word " * 50,
        "  two  blanks  " * 20,
        'it\'s "quoted" and \\ back ' * 10,
        ["share/" + "x" * 40 for _ in range(9)],
        ("share/test", ["assets/" + "y" * 30 for _ in range(9)]),
    ],
)
def test_a_value_is_written_and_read(value: object) -> None:
    text = python_literal(value, 4, "description=")
    assert ast.literal_eval(text) == value
    assert all(len(line) <= WIDTH for line in f"    description={text},".splitlines())


def test_a_word_that_is_too_long_is_marked() -> None:
    text = python_literal(["a", "z" * 200], 4)
    assert ast.literal_eval(text) == ["a", "z" * 200]
    assert all(len(line) <= WIDTH or line.endswith("  # noqa: E501") for line in text.splitlines())
