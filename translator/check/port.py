"""Checks of port values: names, braces, literals, required ports, and types that meet in one entry."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

from translator.action_ports import is_read_as_port
from translator.catalog import NodeModel, PortModel, builtins, did_you_mean, nearest
from translator.diagnostic import Severity
from translator.ros_interfaces import full_name, has_package, interface_fields, interface_names
from translator.ros_nodes import ROS_NODES, with_fields
from translator.tree import BLANKS, Node, Tree, pointer
from translator.values import Fit, describe, fit, outside

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


def _check_names(context: Context, tree: Tree, node: Node, model: NodeModel) -> None:
    for name, text in node.ports.items():
        if name in model.ports:
            continue
        if not is_read_as_port(name):
            context.report_as(Severity.WARNING, "BT0209", tree, node, name, port=name)
        elif not model.open:
            known = ", ".join(model.ports) or "none"
            suggestion = did_you_mean(name, model.ports, otherwise=f"Its ports: {known}.")
            context.report("BT0202", tree, node, name, type=node.type, port=name, suggestion=suggestion)
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
            advice = (
                f"Type {describe(port.type)}, or use a blackboard key: {{key}}."
                if port.direction != "output"
                else "Give it a blackboard key: {key}."
            )
            context.report("BT0201", tree, node, port.name, port=port.name, advice=advice)
        return
    is_literal = not port.is_written or _takes_literal(port)
    is_text = is_literal and fit(port.type, text) is Fit.GOOD
    if port.type == "script" or not check_braces(context, tree, node, port.name, text, is_text=is_text):
        return
    if pointer(text, port.name) is not None:
        if text != text.strip(BLANKS) and not is_queue(port) and is_blank_refused(port.type, text):
            wanted = f"{text.strip(BLANKS)} without blanks, or {describe(port.type)}"
            context.report("BT0204", tree, node, port.name, port=port.name, value=text, wanted=wanted)
        return
    if is_queue(port) and text.startswith("json:"):
        context.report("BT0215", tree, node, port.name)
    if text == "=" and is_text:
        context.report("BT0213", tree, node, port.name, port=port.name)
    if not is_literal:
        context.report("BT0205", tree, node, port.name, port=port.name, value=text)
        return
    check_literal(context, tree, node, port, text)


def is_queue(port: PortModel) -> bool:
    """Returns whether a port is the queue of a loop, which takes entries of any type."""
    return port.direction == "inout" and port.name == "queue" and port.type.startswith("list[")


def is_blank_refused(type_: str, text: str) -> bool:
    """Returns whether a port refuses blanks round a key, since it reads the whole as a literal."""
    return type_ != "status" and fit(type_, text) is Fit.BAD


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


def check_braces(  # noqa: PLR0913 - the place, and what is there
    context: Context, tree: Tree, node: Node, port: str, text: str, *, is_text: bool = True
) -> bool:
    """Reports braces that do not make a key; returns whether they are correct.

    They are a text where the port takes any text.
    """
    stripped = text.strip(BLANKS)
    severity = Severity.WARNING if is_text else None
    if stripped == "{}":
        context.report_as(severity, "BT0207", tree, node, port, port=port)
        return False
    key = pointer(text, port)
    looks_like_key = stripped[:1] == "{" or stripped[-1:] == "}"
    if key is None and looks_like_key and stripped.count("{") != stripped.count("}"):
        context.report_as(severity, "BT0203", tree, node, port, port=port, value=text)
        return False
    if key is not None and ("{" in key or "}" in key or "@" in key[1:]):
        is_refused = key.startswith("@") and "@" in key[1:]
        context.report_as(
            None if is_refused else Severity.WARNING, "BT0208", tree, node, port, port=port, key=key
        )
        return False
    return True
