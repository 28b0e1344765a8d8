"""The state of one child process."""

from __future__ import annotations

from executor.child_messages import Answer, Paused, Starting, Tick
from executor.session.child import Child


def test_it_is_in_use_once_it_received_its_start() -> None:
    child = Child("world", 3)
    child.is_started = True
    assert not child.is_in_use
    child.note(Starting())
    assert child.is_in_use
    assert (child.key, child.vitals.task) == (("world", 3), "loading")


def test_the_last_message_of_a_type_is_stored_until_it_is_forgotten() -> None:
    child = Child("application", 1)
    child.note(Paused())
    assert child.said(Paused) == Paused()
    child.forget(Paused)
    assert child.said(Paused) is None
    child.note(Tick(n=1, t=0.0, changed=[], flashed=[], duration_ms=1.0))
    assert child.said(Tick) is None


def test_only_answers_that_are_expected_are_taken() -> None:
    child = Child("world", 1)
    child.expect("q1")
    assert not child.take_answer(Answer(request="q2"))
    assert child.take_answer(Answer(request="q1"))
    assert child.answer("q1") == Answer(request="q1")
