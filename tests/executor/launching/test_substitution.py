"""Substitutions in launch files."""

from __future__ import annotations

import pytest

from executor.launching.substitution import SubstitutionError, substitute, truth


def test_variables_and_the_folder_are_replaced() -> None:
    assert substitute("$(dirname)/$(var name).yaml", {"name": "map"}, "/p/launch") == "/p/launch/map.yaml"
    assert substitute("$(var 'name')", {"name": "x"}, "") == "x"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("$(var no)", "no argument 'no'"),
        ("$(env HOME)", "is not read here"),
        ("$(var $(var a))", "within another"),
    ],
)
def test_what_is_not_read_is_refused(text: str, message: str) -> None:
    with pytest.raises(SubstitutionError, match=message):
        substitute(text, {"a": "a", "x": "y"}, "")


def test_a_condition_is_true_or_false() -> None:
    assert [truth(text) for text in ("true", " 1 ", "False", "0")] == [True, True, False, False]
    with pytest.raises(SubstitutionError):
        truth("perhaps")
