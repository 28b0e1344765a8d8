"""Switch2 to Switch6."""

from __future__ import annotations

import pytest

from tests.tree_gardener.trees import letters, load
from tree_gardener.controls.switch import equal


@pytest.mark.parametrize(
    ("left", "right", "same"),
    [
        ("a", "a", True),
        ("1", "01", True),
        ("1", "1.0", True),
        ("RED", "5", True),
        ("a", "b", False),
        ("1", "x", False),
    ],
)
def test_texts_are_compared_as_strings_then_as_numbers(left: str, right: str, same: bool) -> None:
    assert equal(left, right, {"RED": 5}) is same


@pytest.mark.parametrize(("value", "result"), [("1", "S"), ("2", "F"), ("3", "K")])
def test_the_last_child_is_for_all_else(value: str, result: str) -> None:
    children = "<Succeeding/><Failing/><Succeeding _skipIf='true'/>"
    tree = load(f"<Switch2 variable='{{x}}' case_1='1' case_2='2'>{children}</Switch2>")
    tree.blackboard["x"] = value
    assert letters(tree, 1) == result
