"""Commands for a world, wherever it is: carried out, answered, refused."""

from __future__ import annotations

from contextlib import nullcontext
from functools import partial
from types import SimpleNamespace
from typing import Any

import pytest

from executor import child_messages
from executor.child_messages import Answer, Failed, Pause, Reset, SetSpeed
from executor.universes.document import DocumentError, Problem
from executor.world.commands import WorldCommands
from executor.world.interface import WorldError


def commands() -> tuple[WorldCommands, list[Any], list[str]]:
    sent: list[Any] = []
    done: list[str] = []
    pulse: Any = SimpleNamespace(busy=nullcontext)
    made = WorldCommands(sent.append, pulse)
    loop: Any = SimpleNamespace(
        pause=lambda: done.append("pause"),
        reset=lambda: done.append("reset"),
        set_speed=lambda speed: done.append(f"speed {speed}"),
    )
    made.loop = loop
    return made, sent, done


def test_a_request_is_answered_and_a_message_is_not() -> None:
    made, sent, done = commands()
    for message in (Pause(), Pause(request="q1"), SetSpeed(2.0, request="q2"), Reset(request="q3")):
        made.answering(message, partial(made.obey, message))
    assert done == ["pause", "pause", "speed 2.0", "reset"]
    assert sent == [Answer(request="q1"), Answer(request="q2"), Answer(request="q3")]


@pytest.mark.parametrize("error", [WorldError("no body"), ValueError("no body"), OSError("no body")])
def test_a_failure_is_an_answer_or_a_message(error: Exception) -> None:
    made, sent, _ = commands()

    def fail() -> None:
        raise error

    made.answering(Pause(request="q1"), fail)
    made.answering(Pause(), fail)
    assert [type(message) for message in sent] == [Answer, Failed]
    assert (sent[0].request, sent[0].error.message) == ("q1", "no body")
    assert sent[1].message == "pause: no body"


def test_a_document_is_refused_with_its_place() -> None:
    made, sent, _ = commands()

    def fail() -> None:
        raise DocumentError([Problem("it is bad", 3, 5, "bad", "write it better")], "room.yaml")

    made.answering(child_messages.Teleop(0, 0), fail)
    assert sent == [Failed("bad", "room.yaml:3:5: it is bad", "write it better")]


def test_before_its_start_a_world_obeys_nothing() -> None:
    made, sent, _ = commands()
    made.loop = None
    made.answering(Pause(request="q1"), lambda: made.obey(Pause(request="q1")))
    assert (sent[0].error.code, len(sent)) == ("not_started", 1)


def test_nodes_that_may_navigate_are_expected_also_before_its_start() -> None:
    made, sent, _ = commands()
    loop, made.loop = made.loop, None
    expected: list[list[str]] = []
    navigation: Any = SimpleNamespace(expect=expected.append)
    made.obey(child_messages.ExpectNavigators(["navigator"]))
    made.loop = loop
    made.join(navigation)
    made.obey(child_messages.ExpectNavigators([]))
    assert (expected, sent) == ([["navigator"], []], [])
