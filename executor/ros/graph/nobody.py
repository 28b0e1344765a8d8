"""Finds subscriptions to what nobody publishes, and clients of services and actions that nobody serves."""

from __future__ import annotations

from difflib import SequenceMatcher
from typing import TYPE_CHECKING, Any, Final

from executor.child_messages import TopicMismatch
from executor.ros.graph.ends import shown_ends

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.node import Node

__all__ = ["topics_of_nobody", "unserved"]

MOST_NAMED: Final = 3
_ACTION: Final = "/_action/send_goal"
# By which simulated time arrives: without it a program ticks by wall time.
_NEEDED_BY_NONE: Final = frozenset({"/clock", "/rosout", "/parameter_events"})


def topics_of_nobody(node: Node, ours: str) -> Iterator[TopicMismatch]:
    """Yields each subscription of a shown node to a topic without a publisher.

    Args:
        node: the node that queries the ROS graph.
        ours: the prefix of the names of the world's own nodes, which wait for commands.
    """
    topics = [name for name, _ in node.get_topic_names_and_types() if "/_" not in name]
    for topic in topics:
        if topic in _NEEDED_BY_NONE or node.count_publishers(topic):
            continue
        for end in shown_ends(node.get_subscriptions_info_by_topic(topic)):
            if not end.node_name.startswith(ours):
                yield _topic(node, topic, end)


def _topic(node: Node, topic: str, end: Any) -> TopicMismatch:
    others = _alike(topic, [
        name
        for name, types in node.get_topic_names_and_types()
        if end.topic_type in types and node.count_publishers(name) and "/_" not in name
    ])  # fmt: skip
    subscriber = f"{end.node_namespace.rstrip('/')}/{end.node_name}"
    message = f"Nothing arrives: {subscriber} subscribes to it, and nobody publishes it here."
    values = {"kind": end.topic_type}
    if not others:
        hint = f"Nobody here publishes {end.topic_type}; look for a sensor or a program that does."
        return TopicMismatch(topic, "", subscriber, "nobody", message, hint, "unpublished", values)
    hint = f"{end.topic_type} is published on {', '.join(others)}: subscribe to that, or remap the name."
    values["others"] = ", ".join(others)
    return TopicMismatch(topic, "", subscriber, "nobody", message, hint, "elsewhere", values)


def unserved(node: Node, ours: str) -> Iterator[TopicMismatch]:
    """Yields each client of a shown node whose service or action has no server; arguments as above."""
    for name, namespace in node.get_node_names_and_namespaces():
        if name.startswith((ours, "_")):
            continue
        for service, types in node.get_client_names_and_types_by_node(name, namespace):
            is_action = service.endswith(_ACTION)
            if ("/_" in service and not is_action) or node.count_services(service):
                continue
            client = f"{namespace.rstrip('/')}/{name}"
            what, shown = ("action", service.removesuffix(_ACTION)) if is_action else ("service", service)
            kind = types[0].removesuffix("_SendGoal")
            message = f"Nobody answers: {client} calls this {what}, and nobody here serves it."
            hint = f"Start a program that serves {kind}, or remap the name."
            values = {"what": what, "kind": kind}
            yield TopicMismatch(shown, "", client, "nobody", message, hint, "unserved", values)


def _alike(topic: str, others: list[str]) -> list[str]:
    """Returns the names that are most like a topic's, the nearest first."""
    return sorted(others, key=lambda name: (-SequenceMatcher(None, topic, name).ratio(), name))[:MOST_NAMED]
