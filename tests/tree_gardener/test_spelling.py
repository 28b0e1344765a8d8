"""Suggestions for misspelt names."""

from __future__ import annotations

import pytest

from tree_gardener.spelling import distance, nearest


@pytest.mark.parametrize(
    ("first", "second", "slips"),
    [("abc", "abc", 0), ("abc", "ab", 1), ("abc", "acb", 1), ("", "abc", 3), ("kitten", "sitting", 3)],
)
def test_letters_that_differ_are_counted(first: str, second: str, slips: int) -> None:
    assert distance(first, second) == distance(second, first) == slips


def test_only_a_name_within_a_third_is_near() -> None:
    known = ["Sequence", "Fallback", "Inverter"]
    assert nearest("Sequenze", known) == "Sequence"
    assert nearest("sequence", known) == "Sequence"
    assert nearest("Xyz", known) == ""
    assert nearest("Sequence", ["Sequence"]) == ""
