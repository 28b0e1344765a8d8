"""The clients of a session: their roles, subscriptions and reconnections."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final
from uuid import uuid4

from executor.messages import Role, StreamName, Subscribe, TopicMessage, Topics

if TYPE_CHECKING:
    from collections.abc import Iterator

    from msgspec import Struct

__all__ = ["MOST_ECHOED_BY_VIEWER", "MOST_STREAMS", "Clients"]

REMEMBERED: Final = 32
# Half of the world's limit for all clients, so that viewers cannot use up the driver's share.
MOST_ECHOED_BY_VIEWER: Final = 12
MOST_STREAMS: Final = 24


@dataclass
class _Client:
    is_here: bool = True
    user: str | None = None
    left_s: float = 0.0
    has_stream: bool = False
    streams: dict[tuple[StreamName, str], Subscribe] = field(default_factory=dict)
    echoed: dict[str, float] = field(default_factory=dict)


class Clients:
    """Stores the clients by id. The first is the driver, later ones are viewers until they take over.

    When the driver's connection is lost, the next client that connects becomes the driver (it may be the same
    page, reloaded). A viewer that is already connected becomes the driver if the session has been without a
    driver for a while.
    """

    def __init__(self, now_s: float) -> None:
        self._clients: dict[str, _Client] = {}
        self._driver: str | None = None
        self._empty_since_s: float | None = now_s

    def client_id(self, resumed: str | None) -> str:
        """Returns the id for a new connection: the old one for a client that reconnects.

        A client may reconnect before the loss of its old connection is noticed. A connection that knows the
        id is accepted as that client.
        """
        return resumed if resumed is not None and resumed in self._clients else uuid4().hex

    @property
    def driver_left_s(self) -> float | None:
        """The time at which the driver's connection was lost; None while it is there."""
        driver = self._clients.get(self._driver) if self._driver is not None else None
        return None if driver is None or driver.is_here else driver.left_s

    def role(self, client: str) -> Role:
        """Returns the client's role."""
        return "driver" if client == self._driver else "viewer"

    def user(self, client: str) -> str | None:
        """Returns who uses a client, as the web server says; None if nobody vouches for a name."""
        return self._clients[client].user if client in self._clients else None

    def join(self, client: str, user: str | None = None) -> None:
        """Adds a client, or marks a known one as connected; `user` is who uses it, if that is known."""
        record = self._clients.setdefault(client, _Client())
        record.is_here, record.user = True, user
        self._empty_since_s = None
        if self._driver is None or not self._clients[self._driver].is_here:
            self._driver = client

    def leave(self, client: str, now_s: float) -> list[str]:
        """Marks a client as disconnected; returns the topics that no client echoes any more."""
        record = self._clients.get(client)
        if record is None:
            return []
        record.is_here, record.left_s = False, now_s
        orphaned = [t for t in record.echoed if not any(self._echoers(t))]
        if not any(c.is_here for c in self._clients.values()):
            self._empty_since_s = now_s
        for gone in [c for c, r in self._clients.items() if not r.is_here][:-REMEMBERED]:
            del self._clients[gone]
            self._driver = None if self._driver == gone else self._driver
        return orphaned

    def deadline_s(self, grace_s: float, promote_s: float) -> float | None:
        """Returns the earliest time at which `promote` or `is_abandoned` can have a new result.

        None if there is none.
        """
        if self._empty_since_s is not None:
            return self._empty_since_s + grace_s if grace_s else None
        if self._driver is not None and not self._clients[self._driver].is_here:
            return self._clients[self._driver].left_s + promote_s
        return None

    def promote(self, now_s: float, promote_s: float) -> list[str]:
        """Makes a viewer the driver if the driver was away for `promote_s`.

        Returns the clients whose role changed.
        """
        driver = self._clients.get(self._driver) if self._driver else None
        if driver is None or driver.is_here or now_s < driver.left_s + promote_s:
            return []
        viewers = self.here()
        if viewers:
            self._driver = viewers[0]
        return viewers[:1]

    def take_over(self, client: str) -> list[str]:
        """Makes a client the driver; returns the connected clients whose role changed."""
        before, self._driver = self._driver, client
        if before == client:
            return []
        return [client, *(c for c in (before,) if c is not None and self._clients[c].is_here)]

    def is_abandoned(self, now_s: float, grace_s: float) -> bool:
        """Returns whether no client was connected during the grace period; a grace period of 0 never ends."""
        return bool(grace_s) and self._empty_since_s is not None and now_s >= self._empty_since_s + grace_s

    def set_stream(self, client: str, *, is_open: bool) -> None:
        """Stores whether the client's stream socket is open."""
        if client in self._clients:
            self._clients[client].has_stream = is_open

    def has_stream(self, client: str) -> bool:
        """Returns whether frames can reach the client: its stream socket is open."""
        return client in self._clients and self._clients[client].has_stream

    def subscribe(self, client: str, data: Subscribe) -> None:
        """Stores a subscription."""
        self._clients[client].streams[data.stream, data.sensor] = data

    def subscribes_to_too_many(self, client: str, data: Subscribe) -> bool:
        """Returns whether a client has reached its limit of subscriptions, without this one."""
        streams = self._clients[client].streams
        return len(streams) >= MOST_STREAMS and (data.stream, data.sensor) not in streams

    def unsubscribe(self, client: str, stream: StreamName, sensor: str) -> None:
        """Removes a subscription."""
        self._clients[client].streams.pop((stream, sensor), None)

    def streams_of(self, client: str) -> list[Subscribe]:
        """Returns the subscriptions of a client; none while its stream socket is closed."""
        return list(self._clients[client].streams.values()) if self.has_stream(client) else []

    def wanted_streams(self) -> Iterator[tuple[str, Subscribe]]:
        """Yields all subscriptions of clients whose stream socket is open, each with its client."""
        for client in self._clients:
            for data in self.streams_of(client):
                yield client, data

    def echo(self, client: str, topic: str, max_hz: float) -> float:
        """Stores the rate at which a client echoes a topic, 0 to end the echo.

        Returns the highest rate of all clients.
        """
        if max_hz > 0:
            self._clients[client].echoed[topic] = max_hz
        else:
            self._clients[client].echoed.pop(topic, None)
        return max((self._clients[c].echoed[topic] for c in self._echoers(topic)), default=0.0)

    def echoes_too_many(self, client: str, topic: str) -> bool:
        """Returns whether a viewer has reached its limit of echoed topics; `topic` itself does not count."""
        echoed = self._clients[client].echoed
        is_full = len(echoed) >= MOST_ECHOED_BY_VIEWER and topic not in echoed
        return is_full and self.role(client) == "viewer"

    def here(self) -> list[str]:
        """Returns the ids of the connected clients."""
        return [client for client, record in self._clients.items() if record.is_here]

    def echoes(self) -> dict[str, float]:
        """Returns the topics that clients echo, each with the highest requested rate."""
        here = [record.echoed for record in self._clients.values() if record.is_here]
        topics = {topic for echoed in here for topic in echoed}
        return {topic: max(echoed.get(topic, 0.0) for echoed in here) for topic in topics}

    def listeners(self, event: Struct) -> list[str]:
        """Returns the clients that receive a `topics` or `topic_message` event."""
        if isinstance(event, TopicMessage):
            return list(self._echoers(event.topic))
        assert isinstance(event, Topics)  # noqa: S101 - the only other type that comes here
        return self.here()

    def _echoers(self, topic: str) -> Iterator[str]:
        return (c for c, record in self._clients.items() if record.is_here and topic in record.echoed)
