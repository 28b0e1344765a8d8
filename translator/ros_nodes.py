"""The ROS nodes of a tree: their ports by the interface, their endpoints and packages."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

from translator.catalog import NodeModel, PortModel, builtins
from translator.endpoints import Endpoint
from translator.ros_interfaces import SEPARATOR, full_name, interface_fields
from translator.tree import pointer

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from translator.tree import Node, Tree


@dataclass(frozen=True, slots=True)
class RosNode:
    """The kind of a ROS node, and the ports that name its endpoint and its type."""

    name: str
    type: str
    kind: str
    endpoint: str


ROS_NODES: Final = {
    "RosAction": RosNode("action_name", "action_type", "action", "action client"),
    "RosService": RosNode("service_name", "service_type", "srv", "client"),
    "RosPublish": RosNode("topic_name", "topic_type", "msg", "publisher"),
    "RosSubscribe": RosNode("topic_name", "topic_type", "msg", "subscription"),
}
_RECEIVED: Final = "RosSubscribe"
_OUTPUTS: Final = ("result", "feedback", "response")
_FIELDS: Final = ("goal", "request", "message", *_OUTPUTS)


def interface_of(node: Node) -> str | None:
    """Returns the full name of the interface that a node states; None if it states none."""
    ros = ROS_NODES.get(node.type)
    text = node.ports.get(ros.type, "") if ros is not None else ""
    if ros is None or not text or pointer(text, ros.type) is not None:
        return None
    return full_name(text, ros.kind)


def with_fields(model: NodeModel, node: Node) -> NodeModel:
    """Returns a node's model, with the fields of its interface as ports if that is installed here."""
    name = interface_of(node)
    fields = interface_fields(name, is_received=node.type == _RECEIVED) if name is not None else None
    if fields is None:
        return model
    ports = {**model.ports, **{each.port: each.model for each in fields}}
    for part in _FIELDS:  # a whole goal or message
        if any(each.port.startswith(f"{part}{SEPARATOR}") for each in fields):
            ports[part] = PortModel(part, direction_of(node.type, part) or "input")
    return replace(model, ports=ports, open=False)


def direction_of(type_: str, port: str) -> str | None:
    """Returns the direction of a field's port by its first part; None for a port that is not a field."""
    if type_ not in ROS_NODES:
        return None
    first = port.partition(SEPARATOR)[0]
    if first not in _FIELDS:
        return None
    is_output = first in _OUTPUTS or (first == "message" and type_ == _RECEIVED)
    return "output" if is_output else "input"


def ros_endpoints(trees: Iterable[Tree]) -> Iterator[Endpoint]:
    """Yields the endpoints that the ROS nodes of trees open."""
    for tree in trees:
        for node in tree.walk():
            ros = ROS_NODES.get(node.type)
            if ros is None:
                continue
            name = node.ports.get(ros.name, "")
            if not name:
                continue
            known = pointer(name, ros.name) is None
            line = node.span.line if node.span else 0
            yield Endpoint(name, ros.endpoint, interface_of(node) or "", known, f"trees/{tree.id}.json", line)


def ros_packages(trees: Iterable[Tree]) -> set[str]:
    """Returns the ROS packages whose interfaces the ROS nodes of trees use."""
    found: set[str] = set()
    for tree in trees:
        for node in tree.walk():
            if (model := builtins().get(node.type)) is None or model.group != "ros":
                continue
            if node.type == "TfLookup":
                found |= {"geometry_msgs", "tf2_msgs"}
            if (name := interface_of(node)) is not None:
                found.add(name.partition("/")[0])
            if node.type == "RosAction":
                found.add("action_msgs")
    return found
