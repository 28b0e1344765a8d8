"""The processes of a session."""

from __future__ import annotations

from executor import child_messages
from executor.session.children import Children
from executor.session.events import Effect, Kill, Retire, Spawn, Tell


def children() -> tuple[Children, list[Effect], list[str]]:
    effects: list[Effect] = []
    lost: list[str] = []
    made = Children(effects.append, lambda: 0.0, lambda: "q1", lambda child, why: lost.append(why))
    return made, effects, lost


def test_there_is_one_of_each_kind() -> None:
    made, effects, _ = children()
    made.replenish()
    made.replenish()
    assert effects == [Spawn("world", 1), Spawn("application", 2)]


def test_an_order_is_sent_with_a_token_that_its_answer_repeats() -> None:
    made, effects, _ = children()
    child, token = made.order("world", child_messages.Pause())
    assert child.answer(token) is None
    assert effects[-1] == Tell("world", 1, child_messages.Pause(request="q1"))


def test_a_child_is_ended_at_once_or_after_a_grace() -> None:
    made, effects, lost = children()
    made.replenish()
    made.drop("world", reason="was ended")
    made.drop("application", grace_s=1.0)
    assert effects[2:] == [
        Kill("world", 1),
        Tell("application", 2, child_messages.Stop()),
        Retire("application", 2, 1.0),
    ]
    assert made.leaving == {("world", 1), ("application", 2)}
    assert lost == ["was ended", "was ended"]
    assert made.living == {}


def test_a_child_that_is_not_there_hears_nothing() -> None:
    made, effects, _ = children()
    made.tell_world(child_messages.Pause())
    made.drop("world")
    assert effects == []
