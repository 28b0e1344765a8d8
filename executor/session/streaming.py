"""Requests to the world to send streams and echoed topics to clients."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor import child_messages
from executor.session.events import StreamClosed, StreamOpened, StreamPaced
from executor.session.ladder import State

if TYPE_CHECKING:
    from executor import messages
    from executor.session.stage import Stage

__all__ = ["close_all", "open_all", "resume_echoes", "subscribe", "take"]


def take(stage: Stage, event: StreamOpened | StreamClosed | StreamPaced) -> None:
    """Handles the opening, closing or pace of a client's stream socket."""
    match event:
        case StreamOpened():
            _open(stage, event.client)
        case StreamClosed():
            _close(stage, event.client)
        case StreamPaced() if stage.state.reaches(State.VISUALIZATION_READY):
            stage.children.tell_world(child_messages.Pace(event.client, event.lost))


def subscribe(stage: Stage, client: str, data: messages.Subscribe) -> None:
    """Asks the world to send one stream to a client."""
    stage.children.tell_world(
        child_messages.Subscribe(client, data.stream, data.max_hz, data.width, data.camera_pose, data.sensor)
    )


def unsubscribe(stage: Stage, client: str, stream: messages.StreamName, sensor: str) -> None:
    """Asks the world to end one stream; a spare one that waits sends none, and would answer with an error."""
    if stage.state.reaches(State.UNIVERSE_READY):
        stage.children.tell_world(child_messages.Unsubscribe(client, stream, sensor))


def leave(stage: Stage, client: str) -> None:
    """Ends the echoes of topics that only this client had."""
    for topic in stage.clients.leave(client, stage.now_s):
        if stage.state.reaches(State.UNIVERSE_READY):
            stage.children.tell_world(child_messages.EchoTopic(topic, 0.0))


def open_all(stage: Stage) -> None:
    """Asks the world for all streams to which clients are subscribed."""
    for client, data in stage.clients.wanted_streams():
        subscribe(stage, client, data)


def close_all(stage: Stage) -> None:
    """Asks the world to end all streams."""
    for client, data in stage.clients.wanted_streams():
        stage.children.tell_world(child_messages.Unsubscribe(client, data.stream, data.sensor))


def resume_echoes(stage: Stage) -> None:
    """Asks a new world to echo the topics that clients echo, as soon as these topics exist."""
    for topic, max_hz in stage.clients.echoes().items():
        stage.children.tell_world(child_messages.EchoTopic(topic, max_hz, patient=True))


def _open(stage: Stage, client: str) -> None:
    stage.clients.set_stream(client, is_open=True)
    if stage.state.reaches(State.VISUALIZATION_READY):
        for data in stage.clients.streams_of(client):
            subscribe(stage, client, data)


def _close(stage: Stage, client: str) -> None:
    for data in stage.clients.streams_of(client):
        unsubscribe(stage, client, data.stream, data.sensor)
    stage.clients.set_stream(client, is_open=False)
