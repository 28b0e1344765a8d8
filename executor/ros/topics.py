"""Looks into a ROS graph for people: which topics there are, what they say, and saying something on one."""

from __future__ import annotations

import array
import time
from collections import deque
from dataclasses import dataclass, field
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

LARGEST_LIST: Final = 400
WINDOW_S: Final = 2.0
LISTEN_S: Final = 10.0
_QOS: Final = QoSProfile(
    depth=5, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE
)
# A picture is heard only by those who asked for it: else listing topics would set the renderer to work.
_UNHEARD: Final = frozenset({"sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2"})


@dataclass
class _Ear:
    """A subscription to one topic, taken raw."""

    type_name: str
    subscription: Any
    heard: deque[tuple[float, int]] = field(default_factory=deque)
    echo_hz: float = 0.0
    next_echo_s: float = 0.0
    until_s: float = 0.0


class Topics:
    """Answers ``list_topics``, ``echo_topic`` and ``publish_topic``. Rates are those of the last seconds."""

    def __init__(self, node: Node, send: Callable[[dict[str, Any]], None]) -> None:
        self._node = node
        self._send = send
        self._ears: dict[str, _Ear] = {}
        self._publishers: dict[tuple[str, str], Any] = {}

    def obey(self, message: dict[str, Any]) -> None:
        """Does what one of the three messages asks.

        Raises:
            ValueError: there is no such type, or its fields are others.
        """
        match message["type"]:
            case "list_topics":
                self._list(time.monotonic())
            case "echo_topic":
                self._echo(str(message["topic"]), float(message["max_hz"]))
            case _:
                self._publish(str(message["topic"]), str(message["message_type"]), message["message"])

    def poll(self, now_s: float) -> None:
        """Takes what was heard, and sends what is echoed."""
        for name, ear in list(self._ears.items()):
            if not ear.echo_hz and now_s > ear.until_s:
                self._forget(name)
                continue
            newest = None
            while (taken := _take_raw(ear.subscription)) is not None:
                ear.heard.append((now_s, len(taken)))
                newest = taken
            while ear.heard and ear.heard[0][0] < now_s - WINDOW_S:
                ear.heard.popleft()
            if newest is not None and ear.echo_hz and now_s >= ear.next_echo_s:
                ear.next_echo_s = now_s + 1.0 / ear.echo_hz
                value = to_builtins(deserialize_message(newest, message_type(ear.type_name)))
                self._send(
                    {"type": "topic_message", "topic": name, "message": value, "message_type": ear.type_name}
                )

    def _list(self, now_s: float) -> None:
        rows = []
        for name, types in sorted(self._node.get_topic_names_and_types()):
            if types[0] not in _UNHEARD and name not in self._ears:
                self._listen(name, types[0])
            ear = self._ears.get(name)
            if ear is not None:
                ear.until_s = now_s + LISTEN_S
            heard = list(ear.heard) if ear else []
            span = max(now_s - heard[0][0], 0.5) if heard else 1.0
            rows.append(
                {
                    "name": name,
                    "type": types[0],
                    "hz": round(len(heard) / span, 1),
                    "bytes_per_s": round(sum(size for _, size in heard) / span),
                }
            )
        self._send({"type": "topics", "topics": rows})

    def _echo(self, name: str, max_hz: float) -> None:
        if max_hz <= 0:
            if name in self._ears:
                self._ears[name].echo_hz = 0.0
            return
        types = dict(self._node.get_topic_names_and_types()).get(name)
        if not types:
            raise ValueError(f"nobody publishes {name}")
        if name not in self._ears:
            self._listen(name, types[0])
        self._ears[name].echo_hz = min(max_hz, 60.0)

    def _publish(self, topic: str, type_name: str, fields: dict[str, Any]) -> None:
        kind = message_type(type_name)
        message = kind()
        fill(message, fields)
        key = (topic, type_name)
        if key not in self._publishers:
            self._publishers[key] = self._node.create_publisher(kind, topic, 10)
        self._publishers[key].publish(message)

    def _listen(self, name: str, type_name: str) -> None:
        try:
            kind = message_type(type_name)
        except ValueError:
            return  # a type that is not installed here: it is listed, not heard
        subscription = self._node.create_subscription(kind, name, _ignore, _QOS, raw=True)
        self._ears[name] = _Ear(type_name, subscription)

    def _forget(self, name: str) -> None:
        self._node.destroy_subscription(self._ears.pop(name).subscription)


def message_type(name: str) -> Any:
    """Returns the class of a message type such as `std_msgs/msg/String`.

    Raises:
        ValueError: it is not installed.
    """
    package, _, kind = name.partition("/msg/")
    try:
        return getattr(import_module(f"{package}.msg"), kind)
    except (ImportError, AttributeError, ValueError) as error:
        raise ValueError(f"the message type {name!r} is not installed") from error


def to_builtins(message: Any) -> Any:
    """Returns a message as dicts, lists and numbers; long arrays are cut."""
    if hasattr(message, "get_fields_and_field_types"):
        return {name: to_builtins(getattr(message, name)) for name in message.get_fields_and_field_types()}
    if isinstance(message, array.array | np.ndarray | list | tuple):
        return [to_builtins(item) for item in message[:LARGEST_LIST]]
    if isinstance(message, bytes):
        return list(message[:LARGEST_LIST])
    return message.item() if isinstance(message, np.generic) else message


def fill(message: Any, fields: dict[str, Any]) -> None:
    """Sets a message's fields from builtins.

    Raises:
        ValueError: there is no such field, or the value is of another kind.
    """
    known = message.get_fields_and_field_types()
    for name, value in fields.items():
        if name not in known:
            raise ValueError(f"{type(message).__name__} has no field {name!r}; it has {', '.join(known)}")
        current = getattr(message, name)
        if hasattr(current, "get_fields_and_field_types"):
            fill(current, value)
            continue
        given = float(value) if isinstance(current, float) and type(value) is int else value
        try:
            # ROS checks fields only when it is told to; a wrong one would crash when it is sent.
            type(message)(check_fields=True, **{name: given})
            setattr(message, name, given)
        except (AssertionError, TypeError) as error:
            raise ValueError(f"{name}: {error}") from error


def _take_raw(subscription: Any) -> bytes | None:
    with subscription.handle:
        taken = subscription.handle.take_message(subscription.msg_type, True)  # noqa: FBT003
    return None if taken is None else taken[0]


def _ignore(message: object) -> None:
    """Never called: messages are taken, no executor spins this node."""
