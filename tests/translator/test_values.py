"""Whether a literal suits the type of a port."""

from __future__ import annotations

import pytest

from translator.values import Fit, choices, describe, fit, outside, type_label


@pytest.mark.parametrize(
    ("type_", "text", "suits"),
    [
        ("int", "-3", Fit.GOOD),
        ("int", "12abc", Fit.LOOSE),
        ("int", "99999999999", Fit.RANGE),
        ("uint", "-3", Fit.BAD),
        ("double", "1e3", Fit.GOOD),
        ("double", "1e400", Fit.RANGE),
        ("bool", "perhaps", Fit.BAD),
        ("status", "SUCCESS", Fit.GOOD),
        ("list[int]", "1;2;x", Fit.BAD),
        ("list[int]", "json:[1]", Fit.GOOD),
        ("list[int]", "json:{}", Fit.BAD),
        ("any", "whatever", Fit.GOOD),
        ("Color[RED;GREEN]", "GREEN", Fit.GOOD),
        ("Color[RED;GREEN]", "7", Fit.GOOD),
        ("Color[RED;GREEN]", "BLUE", Fit.BAD),
        ("Color[RED;GREEN]", "12x", Fit.LOOSE),
        ("Color[RED;GREEN]", "99999999999", Fit.RANGE),
    ],
)
def test_a_literal_suits_its_type_or_not(type_: str, text: str, suits: Fit) -> None:
    assert fit(type_, text) is suits


def test_a_number_that_a_type_cannot_hold_is_named_with_the_limits() -> None:
    assert outside("int", "3000000000") == ("3000000000", str(-(2**31)), str(2**31 - 1))
    assert outside("double", "1e-400") == ("1e-400", "4.9e-324", "1.8e308")
    assert outside("double", "inf") is None
    assert describe("list[int]").startswith("a list")


def test_an_enumeration_is_named_with_its_names() -> None:
    assert choices("Color[RED;GREEN]") == ["RED", "GREEN"]
    assert describe("Color[RED;GREEN]") == "one of RED, GREEN"
    assert [type_label(each) for each in ("Color[RED]", "list[int]", "int")] == ["Color", "list[int]", "int"]
