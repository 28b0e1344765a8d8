"""What the session makes of the messages of its children: events for its clients."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any, Final

import msgspec

from executor import messages
from executor.session.ladder import State

if TYPE_CHECKING:
    from msgspec import Struct

    from executor.session.events import ChildSaid, Kind
    from executor.session.protocol import Session

__all__ = ["APPLICATION_EVENTS", "forward", "hear"]

_log = logging.getLogger(__name__)

APPLICATION_EVENTS: Final[dict[str, type[Struct]]] = {
    "tree": messages.Tree,
    "tick": messages.Tick,
    "blackboard": messages.Blackboard,
    "log": messages.Log,
    "fault": messages.Fault,
    "finished": messages.Finished,
}
"""What an application says that becomes an event of its own name."""
_FORWARDED: Final[dict[Kind, dict[str, type[Struct]]]] = {
    "application": APPLICATION_EVENTS,
    "world": {"log": messages.Log, "sim": messages.Sim, "topic_mismatch": messages.TopicMismatch},
    "node": {},
}
_TOPICS: Final[dict[str, type[Struct]]] = {
    "topics": messages.Topics,
    "topic_message": messages.TopicMessage,
    "type_description": messages.TypeDescription,
}


def hear(session: Session, event: ChildSaid) -> None:
    """Sends what a living child said to those whom it concerns."""
    type_ = event.message["type"]
    if type_ == "progress":
        rung = "launch_universe" if event.kind == "world" else "run_application"
        _emit(session, messages.Progress, {**event.message, "rung": rung})
    elif type_ in _TOPICS:
        _forward_topics(session, event.message, _TOPICS[type_])
    elif type_ == "answer":
        _answer(session, event)
    elif type_ == "error" and session.state.reaches(State.UNIVERSE_READY):
        text = f"{event.message.get('message', '')} {event.message.get('hint', '')}".strip()
        session.emit(messages.Log("world", "error", text))
    elif type_ == "ready" and event.kind == "world":
        session.know_world(str(event.message.get("renderer", "")), has_tf=bool(event.message.get("tf")))
    else:
        forward(session, event)


def forward(session: Session, event: ChildSaid) -> None:
    """Sends a message of a child to all clients, if it is one of those meant for them."""
    message, kind = event.message, _FORWARDED[event.kind].get(event.message["type"])
    if kind is None:
        return
    if kind is messages.Log:
        source = "action" if event.kind == "application" else "world"
        message = {"source": source, "time": session.sim_time_s, **message}
    elif kind is messages.Sim:
        # The world does not know how long ticks take.
        message = {**message, **session.mirror.tick_load()}
    _emit(session, kind, message)


def _emit(session: Session, kind: type[Struct], message: dict[str, Any]) -> None:
    if isinstance(t := message.get("t"), float | int):
        session.sim_time_s = float(t)
    if (payload := _payload(kind, message)) is not None:
        session.emit(payload)


def _payload(kind: type[Struct], message: dict[str, Any]) -> Struct | None:
    try:
        return msgspec.convert(message, kind, strict=False)
    except msgspec.ValidationError as error:
        _log.warning("a %s message of a child is dropped: %s", kind.__name__, error)
        return None


def _answer(session: Session, event: ChildSaid) -> None:
    message = event.message
    if session.children[event.kind].take_answer(message):
        return
    question = session.questions.answered(message.get("request"))
    if question is None:
        return
    given = message.get("error")
    session.answer(question, None if given is None else _payload_error(given))


def _payload_error(given: Any) -> messages.Error:
    try:
        return msgspec.convert(given, messages.Error)
    except msgspec.ValidationError:
        return messages.Error("bad_request", "The command is refused.")


def _forward_topics(session: Session, message: dict[str, Any], kind: type[Struct]) -> None:
    payload = _payload(kind, {**message, "type": message.get("message_type", "")})
    if payload is None:
        return
    if isinstance(payload, messages.TypeDescription):
        asker = session.questions.asker(message.get("request"))
        clients = [asker] if asker is not None else []
    else:
        clients = session.clients.listeners(payload)
    for client in clients:
        session.send(client, payload)
