"""Translates messages of the child processes into events for clients."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor import child_messages, messages
from executor.child_messages import Answer, Failed, Log, Progress, WorldReady, event_of
from executor.session.debugger import holding
from executor.session.ladder import State
from executor.session.questions import answer

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.session.child import Child
    from executor.session.events import ChildSaid
    from executor.session.stage import Stage

__all__ = ["forward", "log"]

_SAME: dict[type[Struct], type[Struct]] = {
    child_messages.Tree: messages.Tree,
    child_messages.Blackboard: messages.Blackboard,
    child_messages.PortSet: messages.PortSet,
    child_messages.Applied: messages.Applied,
    child_messages.Fault: messages.Fault,
    child_messages.Finished: messages.Finished,
    child_messages.TopicMismatch: messages.TopicMismatch,
    child_messages.Forced: messages.Forced,
    child_messages.HeldInPython: messages.HeldInPython,
    child_messages.Attached: messages.Attached,
    child_messages.AttachedTree: messages.AttachedTree,
    child_messages.Profile: messages.Profile,
}
"""Messages that are sent to clients as an event without further change."""


def forward(stage: Stage, child: Child, event: ChildSaid) -> None:
    """Sends a message of a living child to the clients that must receive it."""
    message = event.message
    match message:
        case child_messages.Tick():
            stage.sim_time_s = message.t
            stage.output.emit(event_of(message, messages.Tick))
        case child_messages.Sim() if child is stage.children.holder("world"):
            stage.sim_time_s = message.t
            sim = event_of(message, messages.Sim)
            sim.tick_ms, sim.tick_budget_ms = stage.mirror.tick_load()  # the world does not know these
            stage.output.emit(sim)
        case Log():
            log(stage, event)
        case Progress():
            stage.output.emit(messages.Progress("launch_universe", message.fraction, message.message))
        case Answer():
            _answer(stage, child, message)
        case Failed() if stage.state.reaches(State.UNIVERSE_READY):
            stage.output.emit(messages.Log("world", "error", f"{message.message} {message.hint}".strip()))
        case child_messages.Held() | child_messages.Released() | child_messages.PythonLineWrong():
            _forward_debugger(stage, child, message)
        case WorldReady():
            stage.know_world(message.renderer, has_tf=message.tf)
        case child_messages.Topics() | child_messages.TopicMessage() | child_messages.TypeDescription():
            _forward_topics(stage, message)
        case _:
            if (kind := _SAME.get(type(message))) is not None:
                stage.output.emit(event_of(message, kind))


def log(stage: Stage, event: ChildSaid) -> None:
    """Sends a line of a child's output to all clients, also a last line of a child that was dropped."""
    message = event.message
    if not isinstance(message, Log) or event.kind == "node":
        return
    time_s = stage.sim_time_s if message.time is None else message.time
    is_action = event.kind == "application" and not message.of_world
    source: messages.LogSource = "action" if is_action else "world"
    stage.output.emit(
        messages.Log(source, message.level, message.text, message.node_id, message.node_path, time_s)
    )


def _forward_debugger(
    stage: Stage,
    child: Child,
    message: child_messages.Held | child_messages.Released | child_messages.PythonLineWrong,
) -> None:
    if isinstance(message, child_messages.Held):
        holding.held(stage, child, message)
    elif isinstance(message, child_messages.Released):
        holding.released(stage, child, message)
    else:
        stage.python.cannot_stop(message)


def _answer(stage: Stage, child: Child, message: Answer) -> None:
    if message.request is None or child.take_answer(message):
        return
    question = stage.questions.answered(message.request)
    if question is not None:
        answer(stage, question, message.error)


def _forward_topics(
    stage: Stage,
    message: child_messages.Topics | child_messages.TopicMessage | child_messages.TypeDescription,
) -> None:
    event: messages.Topics | messages.TopicMessage | messages.TypeDescription
    if isinstance(message, child_messages.TypeDescription):
        event = messages.TypeDescription(message.message_type, message.fields, message.example)
        asker = stage.questions.asker(message.request)
        clients = [asker] if asker is not None else []
    elif isinstance(message, child_messages.Topics):
        event = messages.Topics(message.topics)
        clients = stage.clients.listeners(event)
    else:
        event = messages.TopicMessage(
            message.topic, message.message_type, message.message, message.bytes, message.cut
        )
        clients = stage.clients.listeners(event)
    for client in clients:
        stage.output.send(client, event)
