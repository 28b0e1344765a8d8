"""A run that hangs ends and says where."""

from __future__ import annotations

from executor.headless.guard import Guard, sentence


def test_an_error_begins_with_its_place() -> None:
    assert sentence("actions/Go.py", 7, "Go 'go'", 12.0) == (
        "actions/Go.py:7:1: timeout Go 'go' has not returned for 12 s, and was interrupted"
    )


def test_a_run_that_moves_is_left_alone() -> None:
    with Guard() as guard:
        guard.moved()
    assert guard._process.returncode is not None
