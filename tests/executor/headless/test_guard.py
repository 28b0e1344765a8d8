"""A run that hangs ends and says where."""

from __future__ import annotations

import threading
from contextlib import nullcontext
from typing import Any

import pytest

from executor.headless import guard as guard_module
from executor.headless.guard import Guard, Hung, sentence


def test_an_error_begins_with_its_place() -> None:
    assert sentence("actions/Go.py", 7, "Go 'go'", 12.0) == (
        "actions/Go.py:7:1: timeout Go 'go' has not returned for 12 s, and was interrupted"
    )


def test_a_run_that_moves_is_left_alone() -> None:
    with Guard() as guard:
        guard.moved()
    assert guard._process.returncode is not None


USERS = """
def wait(event):
    event.wait(1.5)
"""


@pytest.mark.parametrize("is_suspended", [False, True])
def test_the_time_in_which_a_user_is_asked_is_not_that_of_an_action(
    is_suspended: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(guard_module, "END_AFTER_S", 0.3)
    users: dict[str, Any] = {}
    exec(compile(USERS, "actions/Wait.py", "exec"), users)  # noqa: S102 - the file of an action
    with Guard() as guard:
        asking = guard.suspended() if is_suspended else nullcontext()
        hung = nullcontext() if is_suspended else pytest.raises(Hung, match=r"actions/Wait.py:3")
        with hung, asking:
            users["wait"](threading.Event())
