"""Topic tools for clients: list, echo and publish topics of a ROS graph."""

from __future__ import annotations

import contextlib
import time
from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from rclpy.exceptions import NameValidationException
from rclpy.serialization import deserialize_message

from executor import child_messages
from executor.child_messages import (
    DescribeType,
    EchoTopic,
    ListTopics,
    PublishTopic,
    TopicMessage,
    TypeDescription,
)
from executor.messages import TopicInfo
from executor.ros.graph.ends import shown_ends
from executor.ros.outlet import Outlet, Piped
from executor.ros.raw_subscription import LARGE_TYPES, subscribe_raw
from executor.ros.raw_take import take
from executor.ros.values import FieldError, describe, fill, flatten, message_type, type_name

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

    from executor.ros.node import WorldNode

__all__ = ["TopicError", "TopicReply", "TopicRequest", "Topics"]

TopicRequest = ListTopics | EchoTopic | DescribeType | PublishTopic
TopicReply = child_messages.Topics | TopicMessage | TypeDescription

WINDOW_S: Final = 2.0
LISTEN_S: Final = 10.0
MATCH_S: Final = 1.0
LOOK_S: Final = 0.5
ECHO_MAX_HZ: Final = 60.0
MOST_ECHOED: Final = 24
MOST_PUBLISHERS: Final = 50
MOST_NODES: Final = 20


class TopicError(ValueError):
    """A request cannot be carried out; `code` is the error code for the client."""

    def __init__(self, code: str, message: str) -> None:
        super().__init__(message)
        self.code = code


@dataclass
class _Reader:
    """A subscription to one topic: it measures the rate, and echoes messages while a client requests it."""

    type_name: str
    subscription: Any
    since_s: float
    node: Node
    received: deque[tuple[float, int]] = field(default_factory=deque)
    echo_hz: float = 0.0
    next_echo_s: float = 0.0
    until_s: float = 0.0


@dataclass
class _Unsent:
    """A message that waits until subscribers have discovered its publisher."""

    publisher: Any
    message: Any
    listeners: int
    until_s: float


class Topics:
    """Handles topic requests of clients. Rates are those of the last two seconds of real time.

    Args:
        node: the node that is used for queries, subscriptions and publishers.
        commands: the world's node, whose robots may accept two types on one topic.
        outlet: the outlet through which messages are published; with None, publishers are used directly.
    """

    def __init__(
        self,
        node: Node,
        send: Callable[[TopicReply], None],
        *,
        commands: WorldNode | None = None,
        outlet: Outlet | None = None,
    ) -> None:
        self._node = node
        self._commands = commands
        self._outlet = outlet
        self._send = send
        self._readers: dict[str, _Reader] = {}
        self._publishers: dict[tuple[str, str], Any] = {}
        self._unsent: list[_Unsent] = []
        # Topics that are echoed as soon as they exist.
        self._patient: dict[str, float] = {}
        self._look_s = 0.0

    def obey(self, message: TopicRequest) -> None:
        """Handles a request.

        Raises:
            TopicError: the request cannot be carried out; the text is the reason.
        """
        match message:
            case ListTopics():
                self._list(time.monotonic())
            case EchoTopic(patient=True):
                self._patient[message.topic] = message.max_hz
            case EchoTopic():
                self._patient.pop(message.topic, None)
                self._echo(message.topic, message.max_hz)
            case DescribeType():
                self._describe(message.message_type)
            case PublishTopic():
                self._publish(message.topic, message.message_type, message.message)

    def poll(self, now_s: float) -> None:
        """Reads received messages, sends echoes, and publishes messages that waited for subscribers."""
        self._publish_waiting(now_s)
        self._begin_patient(now_s)
        for name, reader in list(self._readers.items()):
            if not reader.echo_hz and now_s > reader.until_s:
                self._readers.pop(name)
                reader.node.destroy_subscription(reader.subscription)
                continue
            newest = None
            while (taken := take(reader.subscription)) is not None:
                reader.received.append((now_s, len(taken)))
                newest = taken
            while reader.received and reader.received[0][0] < now_s - WINDOW_S:
                reader.received.popleft()
            if newest is not None and reader.echo_hz and now_s >= reader.next_echo_s:
                reader.next_echo_s = now_s + 1.0 / reader.echo_hz
                self._send_echo(name, reader, newest)

    def clear(self) -> None:
        """Ends all echoes."""
        self._patient.clear()
        for reader in self._readers.values():
            reader.echo_hz = 0.0

    def _list(self, now_s: float) -> None:
        rows = []
        for name, there in sorted(self._node.get_topic_names_and_types()):
            types = self._types(name, there)
            if types[0] not in LARGE_TYPES and name not in self._readers:
                self._subscribe(name, types[0], now_s)
            reader = self._readers.get(name)
            if reader is not None:
                reader.until_s = now_s + LISTEN_S
            hz, bytes_per_s = _rates(reader, now_s)
            rows.append(
                TopicInfo(
                    name=name,
                    type=types[0],
                    types=types,
                    hz=hz,
                    bytes_per_s=bytes_per_s,
                    publishers=self._node_names(self._node.get_publishers_info_by_topic(name)),
                    subscribers=self._node_names(
                        self._node.get_subscriptions_info_by_topic(name), own=reader is not None
                    ),
                )
            )
        self._send(child_messages.Topics(topics=rows))

    def _node_names(self, ends: list[Any], *, own: bool = False) -> list[str]:
        """Returns the shown nodes at one end of a topic, except BT Studio's own."""
        names = [f"{end.node_namespace.rstrip('/')}/{end.node_name}" for end in shown_ends(ends)]
        if own and (ours := self._node.get_fully_qualified_name()) in names:
            names.remove(ours)
        return sorted(set(names))[:MOST_NODES]

    def _echo(self, name: str, max_hz: float) -> None:
        if max_hz <= 0:
            if name in self._readers:
                self._readers[name].echo_hz = 0.0
            return
        types = self._types(name, dict(self._node.get_topic_names_and_types()).get(name, []))
        if not types:
            raise TopicError("unknown_topic", f"There is no topic {name!r} in the graph.")
        if name not in self._readers:
            if sum(reader.echo_hz > 0 for reader in self._readers.values()) >= MOST_ECHOED:
                raise TopicError("too_many", f"At most {MOST_ECHOED} topics can be echoed at once.")
            if not self._subscribe(name, types[0], time.monotonic()):
                text = f"{name} is of the type {types[0]}, which is not installed here."
                raise TopicError("unknown_type", text)
        self._readers[name].echo_hz = min(max_hz, ECHO_MAX_HZ)

    def _begin_patient(self, now_s: float) -> None:
        if not self._patient or now_s < self._look_s:
            return
        self._look_s = now_s + LOOK_S
        for name in {name for name, _ in self._node.get_topic_names_and_types()} & set(self._patient):
            with contextlib.suppress(TopicError):  # the error was reported when a client asked
                self._echo(name, self._patient.pop(name))

    def _subscribe(self, name: str, type_name: str, now_s: float) -> bool:
        try:
            kind = message_type(type_name)
        except ValueError:
            return False  # the topic is listed without a rate
        node = self._node_for(name, kind)
        self._readers[name] = _Reader(type_name, subscribe_raw(node, name, kind), now_s, node)
        return True

    def _send_echo(self, name: str, reader: _Reader, raw: bytes) -> None:
        flat = flatten(deserialize_message(raw, message_type(reader.type_name)))
        self._send(
            TopicMessage(
                topic=name, message_type=reader.type_name, message=flat.value, bytes=len(raw), cut=flat.cut
            )
        )

    def _describe(self, type_name: str) -> None:
        try:
            described = describe(type_name)
        except ValueError as error:
            raise TopicError("unknown_type", _sentence(error)) from error
        self._send(TypeDescription(message_type=type_name, **described))

    def _publish(self, topic: str, type_name: str, values: Any) -> None:
        try:
            kind = message_type(type_name)
        except ValueError as error:
            raise TopicError("unknown_type", _sentence(error)) from error
        message = kind()
        try:
            fill(message, values)
        except FieldError as error:
            raise TopicError("bad_message", _sentence(error)) from error
        publisher = self._publisher(topic, kind)
        listeners = self._node.count_subscribers(topic)
        self._unsent.append(_Unsent(publisher, message, listeners, time.monotonic() + MATCH_S))
        self._publish_waiting(time.monotonic())

    def _publisher(self, topic: str, kind: Any) -> Any:
        name = type_name(kind)
        there = dict(self._node.get_topic_names_and_types()).get(topic)
        if there and name not in self._types(topic, there):
            raise TopicError("type_differs", f"{topic} is of the type {there[0]}, not {name}.")
        if (topic, name) not in self._publishers:
            if len(self._publishers) >= MOST_PUBLISHERS:
                raise TopicError("too_many", f"At most {MOST_PUBLISHERS} topics can be published on.")
            try:
                made = self._node_for(topic, kind).create_publisher(kind, topic, 10)
            except (NameValidationException, ValueError, RuntimeError) as error:
                # Only the first line of ROS's text: the others mark the place in it with a caret.
                text = str(error).partition("\n")[0].rstrip(":")
                raise TopicError("bad_topic", f"{topic!r} is no name of a topic: {text}.") from error
            self._publishers[topic, name] = made if self._outlet is None else Piped(made, self._outlet)
        return self._publishers[topic, name]

    def _types(self, topic: str, there: list[str]) -> list[str]:
        """Returns the types of a topic; if a robot accepts several types, the published one is first."""
        takes = () if self._commands is None else self._commands.types_of(topic)
        if not takes or not there:
            return there
        names = [type_name(each) for each in takes]
        published = {end.topic_type for end in self._node.get_publishers_info_by_topic(topic)}
        return sorted(names, key=lambda name: name not in published) + [
            name for name in there if name not in names
        ]

    def _node_for(self, topic: str, kind: type) -> Node:
        return self._node if self._commands is None else self._commands.node_for(topic, kind)

    def _publish_waiting(self, now_s: float) -> None:
        """Publishes waiting messages whose new publisher was discovered by subscribers.

        Earlier they would be lost.
        """
        left = []
        for unsent in self._unsent:
            if unsent.publisher.get_subscription_count() < unsent.listeners and now_s < unsent.until_s:
                left.append(unsent)
            else:
                unsent.publisher.publish(unsent.message)
        self._unsent = left


def _rates(reader: _Reader | None, now_s: float) -> tuple[float | None, float | None]:
    """Returns messages and bytes for each second; None without enough data."""
    if reader is None or now_s - reader.since_s < WINDOW_S / 4:
        return None, None
    span_s = min(now_s - reader.since_s, WINDOW_S)
    received = [size for at_s, size in reader.received if at_s >= now_s - span_s]
    return round(len(received) / span_s, 1), round(sum(received) / span_s)


def _sentence(error: Exception) -> str:
    text = str(error).rstrip(".")
    return f"{text[:1].upper()}{text[1:]}." if not isinstance(error, FieldError) else f"{text}."
