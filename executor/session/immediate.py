"""What commands do that are done at once, or are answered by the world: none of them waits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, cast

from executor import messages
from executor.session.clients import MOST_ECHOED_BY_VIEWER
from executor.session.ladder import State
from executor.session.steps import RESET_TIMEOUT_S

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.session.events import CommandCame
    from executor.session.protocol import Session

__all__ = ["ACTIONS", "ANSWER_LATER"]


def _set_tick_rate(session: Session, event: CommandCame) -> None:
    data = cast("messages.SetTickRate", event.data)

    def note() -> None:
        session.mirror.tick_hz = data.tick_hz

    session.ask("application", event, {"tick_hz": data.tick_hz}, then=note)


def _set_speed(session: Session, event: CommandCame) -> None:
    data = cast("messages.SetSpeed", event.data)

    def note() -> None:
        session.mirror.speed = data.speed

    session.ask("world", event, {"speed": data.speed}, then=note)


def _reset_world(session: Session, event: CommandCame) -> None:
    session.ask("world", event, type_="reset", patience_s=RESET_TIMEOUT_S)


def _subscribe(session: Session, event: CommandCame) -> None:
    data = cast("messages.Subscribe", event.data)
    session.clients.subscribe(event.client, data)
    if session.clients.has_stream(event.client) and session.state.reaches(State.VISUALIZATION_READY):
        session.subscribe(event.client, data)


def _unsubscribe(session: Session, event: CommandCame) -> None:
    data = cast("messages.Unsubscribe", event.data)
    session.clients.unsubscribe(event.client, data.stream)
    session.tell("world", "unsubscribe", client=event.client, stream=data.stream)


def _teleop(session: Session, event: CommandCame) -> None:
    data = cast("messages.Teleop", event.data)
    # A pause freezes tree and world; a world that merely waits for a program goes on for who drives in it.
    goes_on = session.state in (State.UNIVERSE_READY, State.VISUALIZATION_READY)
    session.tell("world", "teleop", linear=data.linear, angular=data.angular, goes_on=goes_on)


def _move_body(session: Session, event: CommandCame) -> None:
    data = cast("messages.MoveBody", event.data)
    session.ask("world", event, {"id": data.id, "pose": data.pose})


def _list_topics(session: Session, event: CommandCame) -> None:
    session.ask("world", event)


def _publish_topic(session: Session, event: CommandCame) -> None:
    data = cast("messages.PublishTopic", event.data)
    # `type` is the channel's own field.
    session.ask("world", event, {"topic": data.topic, "message_type": data.type, "message": data.message})


def _describe_type(session: Session, event: CommandCame) -> None:
    session.ask("world", event, {"message_type": cast("messages.DescribeType", event.data).type})


def _echo_topic(session: Session, event: CommandCame) -> None:
    data = cast("messages.EchoTopic", event.data)
    if data.max_hz > 0 and session.clients.echoes_too_many(event.client, data.topic):
        text = f"A client that looks on may echo {MOST_ECHOED_BY_VIEWER} topics at once."
        session.refuse(event, "too_many", text, "End the echo of another topic first, or take over.")
        return
    rate_hz = session.clients.echo(event.client, data.topic, data.max_hz)
    session.ask("world", event, {"topic": data.topic, "max_hz": rate_hz})


def _restart_node(session: Session, event: CommandCame) -> None:
    problem = session.nodes.restart(session, cast("messages.RestartNode", event.data).id)
    if problem:
        session.refuse(event, "unknown_node", problem)
    else:
        session.send(event.client, messages.Ack(), event.request)


def _take_over(session: Session, event: CommandCame) -> None:
    for client in session.clients.take_over(event.client):
        session.introspect(client)


def _ping(_: Session, __: CommandCame) -> None:
    """The answer is all that is asked for."""


ACTIONS: Final[dict[str, Callable[[Session, CommandCame], None]]] = {
    "set_tick_rate": _set_tick_rate,
    "set_speed": _set_speed,
    "reset_world": _reset_world,
    "subscribe": _subscribe,
    "unsubscribe": _unsubscribe,
    "echo_topic": _echo_topic,
    "publish_topic": _publish_topic,
    "move_body": _move_body,
    "list_topics": _list_topics,
    "describe_type": _describe_type,
    "restart_node": _restart_node,
    "teleop": _teleop,
    "take_over": _take_over,
    "ping": _ping,
}

ANSWER_LATER: Final = frozenset(
    {
        "set_tick_rate",
        "set_speed",
        "reset_world",
        "move_body",
        "list_topics",
        "echo_topic",
        "publish_topic",
        "describe_type",
        "restart_node",
    }
)
"""Those that answer by themselves, or have a child do it."""
