"""The channel of a run that is made again is quiet, and says afterwards what counts."""

from __future__ import annotations

from typing import Any

from executor import child_messages, messages
from executor.exact.gate import Gate


class Channel:
    """Keeps what is sent."""

    def __init__(self) -> None:
        self.sent: list[Any] = []

    def send(self, message: Any) -> None:
        self.sent.append(message)

    def receive(self, timeout_s: float | None = None) -> float | None:
        return timeout_s

    def flush(self, timeout_s: float) -> bool:
        return timeout_s > 0


def port(value: str) -> child_messages.PortSet:
    return child_messages.PortSet("n1", "Main", "p", "gain", value, None, "next_tick")


def test_only_its_progress_is_sent_while_it_is_closed() -> None:
    channel: Any = Channel()
    gate = Gate(channel)
    gate.send(child_messages.Log("info", "before"))
    gate.close_for_replay()
    gate.send(child_messages.Log("info", "again"))
    gate.send(child_messages.GoingBack(0.5))
    gate.open()
    gate.send(child_messages.Log("info", "after"))
    kinds = [getattr(message, "text", "progress") for message in channel.sent]
    assert kinds == ["before", "progress", "after"]
    assert (gate.receive(0.5), gate.flush(1.0)) == (0.5, True)


def test_ports_and_forced_results_are_sent_at_the_end_in_their_last_state() -> None:
    channel: Any = Channel()
    gate = Gate(channel)
    gate.close_for_replay()
    forced = child_messages.Forced(
        [messages.ForcedNode(2, "SUCCESS", once=False, after=False, skips_to=False)], 0
    )
    for message in (port("1"), child_messages.Forced([], 0), port("2"), forced):
        gate.send(message)
    assert channel.sent == []
    gate.open()
    gate.send_state()
    assert channel.sent == [port("2"), forced]
    gate.send_state()  # a snapshot of the run needs them again
    assert channel.sent[2:] == [port("2"), forced]


def test_ports_from_before_a_changed_tree_are_gone() -> None:
    channel: Any = Channel()
    gate = Gate(channel)
    gate.close_for_replay()
    gate.send(port("1"))
    gate.send(child_messages.Applied(False, 1, [], [], [], [], []))
    gate.open()
    gate.send_state()
    assert channel.sent == []
