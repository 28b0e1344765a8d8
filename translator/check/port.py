"""Checks of port values: names, braces, literals, required ports, and types that meet in one entry."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from translator.action_ports import is_port_name
from translator.catalog import NodeModel, PortModel, builtins, did_you_mean, nearest
from translator.ros_interfaces import full_name, has_package, interface_fields, interface_names
from translator.ros_nodes import ROS_NODES, with_fields
from translator.tree import BLANKS, Node, Tree, pointer
from translator.values import Fit, describe, fit, outside, type_label

if TYPE_CHECKING:
    from translator.check.context import Context

_ROS_NAME = re.compile(r"(?:/|~/|~\Z)?(?:[A-Za-z_]\w*(?:/[A-Za-z_]\w*)*)?", re.ASCII)
ROS_NAMES = {
    "action_name": "/navigate_to_pose",
    "service_name": "/reset",
    "topic_name": "/cmd_vel",
    "node_name": "/controller_server",
}
EXAMPLES = {
    "action": "nav2_msgs/action/NavigateToPose",
    "srv": "std_srvs/srv/Trigger",
    "msg": "geometry_msgs/msg/Twist",
}


def check_ports(context: Context) -> None:
    """Reports port values that the engine would refuse, or whose meaning differs from their appearance."""
    for tree in context.project.trees.values():
        entries: dict[str, _Use] = {}
        for node in tree.walk():
            model = context.model(node.type)
            if model is None or node.is_subtree:
                continue
            typed = with_fields(model, node)
            _check_interface(context, tree, node)
            _check_ros_names(context, tree, node)
            _check_names(context, tree, node, typed)
            for port in typed.ports.values():
                _check_port(context, tree, node, port)
            for port in model.ports.values():  # fields convert values: they fix no type of an entry
                _check_entry(context, tree, node, port, entries)


def _check_names(context: Context, tree: Tree, node: Node, model: NodeModel) -> None:
    for name, text in node.ports.items():
        if name in model.ports:
            continue
        if not model.open:
            known = ", ".join(model.ports) or "none"
            suggestion = did_you_mean(name, model.ports, otherwise=f"Its ports: {known}.")
            context.report("BT0202", tree, node, name, type=node.type, port=name, suggestion=suggestion)
        elif not is_port_name(name):
            context.report("BT0209", tree, node, name, port=name)
        else:
            check_braces(context, tree, node, name, text)


def is_ros_name(name: str) -> bool:
    """Returns whether a text names a topic, service, action or node of ROS, as the engine decides it."""
    return name not in {"", "/", "~/"} and _ROS_NAME.fullmatch(name) is not None


def _check_ros_names(context: Context, tree: Tree, node: Node) -> None:
    for port, example in ROS_NAMES.items():
        text = node.ports.get(port, "").strip() if node.type in ROS_NODES or node.type == "RosParam" else ""
        name = text.rstrip("/") if port == "node_name" else text
        if text and pointer(text, port) is None and not is_ros_name(name):
            wanted = f"a name in ROS, such as {example}"
            context.report("BT0204", tree, node, port, port=port, value=text, wanted=wanted)


def _check_interface(context: Context, tree: Tree, node: Node) -> None:
    """Reports a type of a ROS node that is not the name of one, or that its package has not."""
    ros = ROS_NODES.get(node.type)
    text = node.ports.get(ros.type, "") if ros is not None else ""
    if ros is None or not text or pointer(text, ros.type) is not None:
        return
    name = full_name(text, ros.kind)
    if name is not None and (interface_fields(name) is not None or not has_package(name)):
        return  # a package that is not here may be where the tree runs
    near = nearest(name or text, [each for each, kind in interface_names() if kind == ros.kind])
    wanted = f"an installed type of this kind, such as {near or EXAMPLES[ros.kind]}"
    context.report("BT0204", tree, node, ros.type, port=ros.type, value=text, wanted=wanted)


def _check_port(context: Context, tree: Tree, node: Node, port: PortModel) -> None:
    text = node.ports.get(port.name)
    if text is None or (not text and _names_entry(node, port)):
        if port.required and port.default is None:
            context.report(
                "BT0201", tree, node, port.name, type=node.type, port=port.name, description=port.description
            )
        return
    if port.type == "script" or not check_braces(context, tree, node, port.name, text):
        return
    if pointer(text, port.name) is not None:
        return
    if port.is_written and not _takes_literal(port):
        context.report("BT0205", tree, node, port.name, port=port.name, value=text)
        return
    check_literal(context, tree, node, port, text)


def check_literal(context: Context, tree: Tree, node: Node, port: PortModel, text: str) -> None:
    """Reports a literal that is not of its port's type."""
    if port.is_object and text.startswith("json:") and not _is_json(text[len("json:") :]):
        context.report(
            "BT0204", tree, node, port.name, port=port.name, value=text, wanted="JSON after “json:”"
        )
        return
    suits = fit(port.type, text)
    values = {"port": port.name, "value": text, "wanted": describe(port.type)}
    if suits is Fit.RANGE and (found := outside(port.type, text)) is not None:
        number, low, high = found
        context.report("BT0212", tree, node, port.name, port=port.name, number=number, low=low, high=high)
    elif suits is Fit.BAD:
        context.report("BT0204", tree, node, port.name, **values)
    elif suits is Fit.LOOSE:
        context.report("BT0206", tree, node, port.name, **values)


def _is_json(text: str) -> bool:
    try:
        json.loads(text)
    except (ValueError, RecursionError):
        return False
    return True


def _names_entry(node: Node, port: PortModel) -> bool:
    """Returns whether a port must name an entry: that of a built-in node that watches an entry."""
    return port.name == "entry" and node.type in builtins()


def _takes_literal(port: PortModel) -> bool:
    """Returns whether an output may be a literal: an inout that is then only read, or a key's name."""
    return port.direction == "inout" and port.name in {"queue", "output_key"}


def check_braces(context: Context, tree: Tree, node: Node, port: str, text: str) -> bool:
    """Reports braces that do not make a key; returns whether they are correct."""
    stripped = text.strip(BLANKS)
    if stripped == "{}":
        context.report("BT0207", tree, node, port, port=port)
        return False
    if stripped.count("{") != stripped.count("}") and (stripped[0] == "{" or stripped[-1] == "}"):
        context.report("BT0203", tree, node, port, port=port, value=text)
        return False
    key = pointer(text, port)
    if key is not None and ("{" in key or "}" in key or key.count("@") > 1 or "@" in key[1:]):
        context.report("BT0208", tree, node, port, port=port, key=key)
        return False
    return True


@dataclass(frozen=True, slots=True)
class _Use:
    """The first typed use of a blackboard entry."""

    type: str
    node: Node
    port: str


def _check_entry(context: Context, tree: Tree, node: Node, port: PortModel, entries: dict[str, _Use]) -> None:
    """Reports an entry that two ports use with different types; the engine refuses it."""
    text = node.ports.get(port.name, port.default)
    key = pointer(text, port.name) if text is not None else None
    # SetBlackboard copies a value of any type, although its port is a text in the catalogue.
    if key is None or port.type in {"any", "script", "status"} or node.type == "SetBlackboard":
        return
    first = entries.setdefault(key, _Use(port.type, node, port.name))
    if first.type not in {port.type, "string"}:
        context.report(
            "BT0210",
            tree,
            node,
            port.name,
            key=key,
            type=type_label(port.type),
            other_type=type_label(first.type),
            other=f"{first.node.label} ({first.node.id}), port {first.port}",
        )
