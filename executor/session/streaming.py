"""Stream sockets that open, close and fall behind: what the world is asked to send for each client."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.session.events import StreamClosed, StreamOpened, StreamPaced
from executor.session.ladder import State

if TYPE_CHECKING:
    from executor.session.protocol import Session

__all__ = ["heard"]


def heard(session: Session, event: StreamOpened | StreamClosed | StreamPaced) -> None:
    """Has the world send what a client wants to see, as fast as it can take it."""
    match event:
        case StreamOpened():
            _open(session, event.client)
        case StreamClosed():
            _close(session, event.client)
        case StreamPaced() if session.state.reaches(State.VISUALIZATION_READY):
            session.tell("world", "pace", client=event.client, lost=event.lost)


def _open(session: Session, client: str) -> None:
    session.clients.set_stream(client, is_open=True)
    if session.state.reaches(State.VISUALIZATION_READY):
        for data in session.clients.streams_of(client):
            session.subscribe(client, data)


def _close(session: Session, client: str) -> None:
    for data in session.clients.streams_of(client):
        session.tell("world", "unsubscribe", client=client, stream=data.stream)
    session.clients.set_stream(client, is_open=False)
