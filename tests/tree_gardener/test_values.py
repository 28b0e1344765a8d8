"""Values of ports and entries."""

from __future__ import annotations

from typing import Any

import pytest

from tree_gardener.values import BY_NAME, ConversionError, parse_double, to_bool, value_type


@pytest.mark.parametrize(
    ("kind", "value", "expected"),
    [
        *(("bool", 2.5, True), ("int", True, 1), ("double", "2.5", 2.5), ("string", True, "1")),
        *(("string", float("inf"), "inf"), ("status", "SUCCESS", None), ("list[int]", (1, 2), (1, 2))),
    ],
)
def test_conversions(kind: str, value: Any, expected: Any) -> None:
    found = BY_NAME[kind].convert(value)
    assert found == expected or (expected is None and found.name == value)


@pytest.mark.parametrize(
    ("annotation", "name"),
    [(int, "int"), (list[float], "list[double]"), ("bool", "bool"), ("no such", "any"), (Any, "any")],
)
def test_a_type_has_the_name_of_the_catalogue(annotation: Any, name: str) -> None:
    assert value_type(annotation).name == name


def test_what_no_double_can_hold_is_refused() -> None:
    assert parse_double("1.5m") == 1.5
    for text in ("1e400", "1e-400", "m"):
        with pytest.raises(ConversionError):
            parse_double(text)


def test_a_number_is_true_only_where_the_library_says_so() -> None:
    assert [to_bool(value) for value in (0, 1, 0.0, 2.5, True)] == [False, True, False, True, True]
    for value in (2, -1.0, "true"):
        with pytest.raises(ConversionError):
            to_bool(value)
