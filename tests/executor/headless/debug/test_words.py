from __future__ import annotations

import pytest

from executor.headless.debug.words import WordsError, breakpoint_of, split, whole
from tree_gardener import Status
from tree_gardener.debugging import Breakpoint, Place, When


def place_named(name: str) -> Place:
    return Place("Main", name)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("a", Breakpoint(Place("Main", "a"))),
        ("'a b' after", Breakpoint(Place("Main", "a b"), When.AFTER)),
        ("a failure", Breakpoint(Place("Main", "a"), When.RETURNS, Status.FAILURE)),
        ("a halted hits 3", Breakpoint(Place("Main", "a"), When.HALTED, hits=3)),
        ("a if 'x > 1' log 'x is {x}'", Breakpoint(Place("Main", "a"), condition="x > 1", log="x is {x}")),
    ],
)
def test_the_words_of_a_breakpoint(line: str, expected: Breakpoint) -> None:
    assert breakpoint_of(line, place_named) == expected


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("", "name a node"),
        ("a sometimes", "'sometimes' is not one of before, after"),
        ("a if", "nothing stands behind 'if'"),
        ("a hits many", "'many' is no number"),
        (f"a hits {'9' * 5000}", "'9{20}' is no number, or too large"),
        ("a if 'x", "No closing quotation"),
    ],
)
def test_wrong_words_are_refused(line: str, why: str) -> None:
    with pytest.raises(WordsError, match=why):
        breakpoint_of(line, place_named)


@pytest.mark.parametrize(
    ("text", "number"), [("0", 0), ("123456789", 123456789), ("1" * 10, None), ("-1", None), ("", None)]
)
def test_a_number_is_read_only_where_it_is_small(text: str, number: int | None) -> None:
    assert whole(text) == number


def test_quotes_hold_words_together() -> None:
    assert split("force 'a b' success") == ["force", "a b", "success"]
