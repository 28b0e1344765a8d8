"""Commands of clients that a child answers."""

from __future__ import annotations

from executor import messages
from executor.session.events import Kind, Send
from executor.session.questions import ANSWER_S, Questions, answer_late
from tests.executor.session.play import Play

WORLD: tuple[Kind, int] = ("world", 1)


def test_a_question_is_answered_once() -> None:
    questions = Questions()
    token = questions.add("c", "r", ("world", 1), 0.0, topic="/scan")
    assert questions.asker(token) == "c"
    found = questions.answered(token)
    assert found is not None
    assert (found.request, found.topic) == ("r", "/scan")
    assert questions.answered(token) is None
    assert questions.asker(None) is None


def test_it_expires_or_goes_with_its_child() -> None:
    questions = Questions()
    questions.add("c", "r1", ("world", 1), 0.0)
    questions.add("c", "r2", ("application", 2), 1.0)
    assert questions.deadline_s == ANSWER_S
    assert [found.request for found in questions.expired(ANSWER_S)] == ["r1"]
    assert [found.request for found in questions.orphaned(("application", 2))] == ["r2"]
    assert questions.deadline_s is None


def test_one_that_is_late_is_kept_if_the_session_keeps_what_is_asked() -> None:
    play = Play()
    asked, called = Questions(), list[str]()
    asked.add("d", "kept", WORLD, 0.0, then=lambda: called.append("then"), late=lambda: called.append("late"))
    asked.add("d", "lost", WORLD, 0.0, then=lambda: called.append("then"), refused=lambda: None)
    answer_late(play.session, asked.orphaned(WORLD), "timeout", "did not answer in time")
    play.later(0.0)
    sent = {e.request: e.payload for e in play.effects if isinstance(e, Send)}
    assert called == ["late"]
    assert sent["kept"] == messages.Ack()
    assert sent["lost"] == messages.Error("timeout", "The world did not answer in time.")
