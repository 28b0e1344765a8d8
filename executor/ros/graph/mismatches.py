"""Detects topics whose ends do not match: messages never arrive, and no error is reported."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from msgspec.structs import replace
from rclpy.qos import DurabilityPolicy, QoSCompatibility, ReliabilityPolicy, qos_check_compatible

from executor.child_messages import TopicMismatch
from executor.ros.graph.ends import shown_ends
from executor.ros.graph.nobody import topics_of_nobody, unserved

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rclpy.node import Node

    from executor.messages import MismatchCode

__all__ = ["Mismatches"]

LOOK_S: Final = 1.0
PATIENCE: Final = 5
OURS: Final = "world"
"""Prefix of the names of the world's own nodes, which may subscribe to a topic with more than one type."""
_IGNORED: Final = ("/rosout", "/parameter_events")


_Key = tuple[str, str, str, str]


class Mismatches:
    """Finds topics whose ends do not match, and reports each mismatch once while it exists, and its end.

    Args:
        node: the node that queries the ROS graph.
        report: is called with each mismatch.
        patience: the number of checks that must find that an end is missing; it may come later.
    """

    def __init__(
        self, node: Node, report: Callable[[TopicMismatch], None], *, patience: int = PATIENCE
    ) -> None:
        self._node = node
        self._report = report
        self._patience = patience
        self._told: dict[_Key, TopicMismatch] = {}
        self._seen: dict[_Key, int] = {}
        self._look_s = 0.0

    def poll(self, now_s: float) -> None:
        """Checks the graph, at most once a second of real time."""
        if now_s >= self._look_s:
            self._look_s = now_s + LOOK_S
            self.look()

    def look(self) -> None:
        """Checks the graph now."""
        present: dict[_Key, int] = {}
        for found in (*topics_of_nobody(self._node, OURS), *unserved(self._node, OURS)):
            self._take(found, present, self._patience)
        for topic, _ in self._node.get_topic_names_and_types():
            if topic in _IGNORED:
                continue
            publishers = shown_ends(self._node.get_publishers_info_by_topic(topic))
            subscribers = shown_ends(self._node.get_subscriptions_info_by_topic(topic))
            for found in (
                *_types_differ(topic, publishers, subscribers),
                *_qos_differs(topic, publishers, subscribers),
            ):
                self._take(found, present, 2 if _may_pass(found) else 1)
        self._seen = present
        for key in self._told.keys() - present.keys():
            self._report(replace(self._told.pop(key), resolved=True))

    def _take(self, found: TopicMismatch, present: dict[_Key, int], patience: int) -> None:
        """Reports a mismatch that so many checks in a row have found."""
        key = (found.topic, found.publisher, found.subscriber, found.message)
        present[key] = self._seen.get(key, 0) + 1
        if key not in self._told and present[key] >= patience:
            self._told[key] = found
            self._report(found)


def _may_pass(found: TopicMismatch) -> bool:
    """Returns whether a mismatch may disappear soon: a robot can change its subscription's type."""
    return found.reason == "type" and found.subscriber.startswith(f"/{OURS}")


def _name(end: Any) -> str:
    return f"{end.node_namespace.rstrip('/')}/{end.node_name}"


def _types_differ(topic: str, publishers: list[Any], subscribers: list[Any]) -> Iterator[TopicMismatch]:
    said, heard = {end.topic_type for end in publishers}, {end.topic_type for end in subscribers}
    for publisher in publishers:
        for subscriber in subscribers:
            if publisher.topic_type == subscriber.topic_type:
                continue
            is_lost = publisher.topic_type not in heard
            is_deaf = subscriber.topic_type not in said and not subscriber.node_name.startswith(OURS)
            if is_lost or is_deaf:
                yield TopicMismatch(
                    topic,
                    _name(publisher),
                    _name(subscriber),
                    "type",
                    f"Nothing arrives: {_name(publisher)} publishes {publisher.topic_type}, "
                    f"{_name(subscriber)} subscribes to {subscriber.topic_type}.",
                    "Use the same message type at both ends.",
                    "type",
                    {"published": publisher.topic_type, "wanted": subscriber.topic_type},
                )


def _qos_differs(topic: str, publishers: list[Any], subscribers: list[Any]) -> Iterator[TopicMismatch]:
    for publisher in publishers:
        for subscriber in subscribers:
            if publisher.topic_type != subscriber.topic_type:
                continue
            said, wanted = publisher.qos_profile, subscriber.qos_profile
            compatible, reason = qos_check_compatible(said, wanted)
            if compatible == QoSCompatibility.ERROR:
                code, text, hint = _explained(publisher, subscriber, reason)
                ends = _name(publisher), _name(subscriber)
                message = f"Nothing arrives: {text}."
                values = {"problem": _plain(reason)}
                yield TopicMismatch(topic, *ends, "qos", message, hint, code, values)


def _plain(reason: str) -> str:
    return reason.strip().rstrip(";").removeprefix("ERROR: ")


def _explained(publisher: Any, subscriber: Any, reason: str) -> tuple[MismatchCode, str, str]:
    said, wanted = publisher.qos_profile, subscriber.qos_profile
    if said.reliability is ReliabilityPolicy.BEST_EFFORT and wanted.reliability is ReliabilityPolicy.RELIABLE:
        return (
            "reliability",
            f"{_name(publisher)} publishes best effort, {_name(subscriber)} asks for reliable delivery",
            "Subscribe with rclpy.qos.qos_profile_sensor_data, or publish with QoSProfile(depth=10).",
        )
    if said.durability is DurabilityPolicy.VOLATILE and wanted.durability is DurabilityPolicy.TRANSIENT_LOCAL:
        return (
            "durability",
            f"{_name(publisher)} keeps nothing for late subscribers, {_name(subscriber)} asks for that",
            "Subscribe with DurabilityPolicy.VOLATILE, or publish with DurabilityPolicy.TRANSIENT_LOCAL.",
        )
    return (
        "qos",
        f"{_name(publisher)} and {_name(subscriber)} differ in quality of service: {_plain(reason)}",
        "Use the same QoSProfile at both ends.",
    )
