"""Conditions that a step of the session waits for."""

from __future__ import annotations

import pytest

from executor.child_messages import Paused, Resumed
from executor.session.child import Child
from executor.session.waits import NOT_ANSWERING, StepFailed, answered, gone, is_spare_lost, message_of, taken


def test_a_message_ends_the_wait() -> None:
    child = Child("application", 1)
    until = message_of(child, Paused, Resumed)
    assert until() is None
    child.note(Resumed())
    assert until() == Resumed()


def test_the_end_of_the_child_fails_it_with_its_last_lines() -> None:
    child = Child("application", 1)
    child.end("ended with exit code 3", ("one", "two"))
    with pytest.raises(StepFailed, match="The application ended with exit code 3") as failed:
        message_of(child, Paused)()
    assert (failed.value.code, failed.value.hint) == ("process_died", "one\ntwo")
    assert gone(child)()
    assert is_spare_lost(child, failed.value)


def test_a_hang_fails_it_where_an_answer_is_due() -> None:
    child = Child("world", 1)
    child.hang = "The world does not answer."
    child.vitals.silent_s = 9.0
    for condition in (answered(child, Paused), taken(child, Paused)):
        with pytest.raises(StepFailed) as failed:
            condition()
        assert failed.value.code == NOT_ANSWERING
    assert message_of(child, Paused)() is None
