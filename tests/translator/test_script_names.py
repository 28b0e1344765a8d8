"""The names in a script, without running it."""

from __future__ import annotations

from translator.limits import SCRIPT_CHARACTERS
from translator.script_names import MAX_INTEGER, integers_too_large, script_names


def test_names_that_are_read_and_written_are_distinguished() -> None:
    names = script_names("x := a + b; y := x; x += 1")
    assert set(names.written) == {"x", "y"}
    assert {"a", "b"} <= set(names.read)
    assert names.problem is None


def test_a_script_that_cannot_be_read_has_a_problem_with_its_place() -> None:
    problem = script_names("x := ").problem
    assert problem is not None
    assert problem.offset >= 3
    long = script_names("x" * (SCRIPT_CHARACTERS + 1)).problem
    assert long is not None
    assert "longer" in long.message


def test_integers_beyond_64_bits_are_found() -> None:
    assert integers_too_large(f"x := {MAX_INTEGER}") == []
    assert integers_too_large(f"x := {MAX_INTEGER + 1}; y := 1") == [str(MAX_INTEGER + 1)]
