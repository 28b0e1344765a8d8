"""The output of a session: order, mirroring, and answers to commands."""

from __future__ import annotations

from executor import messages
from executor.session.events import CommandCame, EndSession, Send
from executor.session.mirror import Mirror
from executor.session.output import Output


def test_effects_are_taken_once_and_in_order() -> None:
    output = Output(Mirror())
    output.send("a", messages.Ack(), "1")
    output.effect(EndSession("over"))
    output.emit(messages.Log("manager", "info", "text"))
    sent, ended, logged = output.take()
    assert sent == Send("a", "ack", messages.Ack(), "1")
    assert ended == EndSession("over")
    assert isinstance(logged, Send)
    assert logged.client is None
    assert output.take() == []


def test_what_all_clients_get_is_mirrored_and_what_one_gets_is_not() -> None:
    mirror = Mirror()
    output = Output(mirror)
    output.send("a", messages.Log("manager", "info", "for one"))
    output.emit(messages.Log("manager", "info", "for all"))
    assert [line.text for line in mirror.snapshot().logs] == ["for all"]


def test_a_refusal_answers_its_command() -> None:
    output = Output(Mirror())
    output.refuse(CommandCame("a", "7", "pause", messages.Ack()), "busy", "Not now.", "Wait.")
    assert output.take() == [Send("a", "error", messages.Error("busy", "Not now.", "Wait."), "7")]
