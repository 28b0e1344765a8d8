"""Writes docs/reference/nodes.md from the engine's classes and its catalogue.

python -m tests.tree_gardener.reference_page
"""

from __future__ import annotations

import inspect
import re
from pathlib import Path
from typing import TYPE_CHECKING

from tree_gardener import catalog
from tree_gardener.registry import BUILT_IN
from tree_gardener.ros_nodes import NODES as ROS_NODES

if TYPE_CHECKING:
    from tree_gardener.catalog import CatalogNode, CatalogPort

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "nodes.md"
TITLES = {
    "control": "Control nodes",
    "decorator": "Decorators",
    "action": "Actions",
    "condition": "Conditions",
    "subtree": "SubTree",
    "ros": "ROS",
}
INTRODUCTION = """# Nodes

<!-- Written by tests/tree_gardener/reference_page.py; do not edit. -->

The nodes that `tree_gardener` brings. Names, ports and rules are those of BehaviorTree.CPP 4; where 4.9 or
later is needed, it says so. Every node also takes the pre-conditions `_failureIf`, `_successIf`, `_skipIf`,
`_while` and the post-conditions `_onSuccess`, `_onFailure`, `_post`, `_onHalted`.
"""

ROS = """These are not in BehaviorTree.CPP; names and meaning follow the base classes of BehaviorTree.ROS2.
The fields of the interface are ports: `goal__`, `result__` and `feedback__` of
an action, `request__` and `response__` of a service, `message__` of a topic, each with the path of the
field, whose parts are joined by two underscores: `goal__pose__pose__position__x="1.5"`. A quaternion has
also the field `yaw`. A list is written `1;2;3`, a time in seconds (or `now`), a whole message as an
entry of the type, or as `json:{"x": 1.0}`. No tick waits: while a server is missing or has not answered,
the node is RUNNING. Timeouts are in ROS time, simulated time in a simulation. When a node is halted, its
goal is cancelled.
"""


def page() -> str:
    """The page's text."""
    parts = [INTRODUCTION]
    for kind, title in TITLES.items():
        parts.append(f"## {title}\n")
        parts += [ROS] if kind == "ros" else []
        parts += [section(node) for node in catalog.load().values() if (node.group or node.kind) == kind]
    return "\n".join(parts)


def section(node: CatalogNode) -> str:
    """Returns the section of one node."""
    lines = [f"### `{node.type}` {node.symbol}\n", f"{node.summary} {children(node)}".strip() + "\n"]
    lines += [rule(node) + "\n"] if rule(node) else []
    if node.ports:
        lines += ["| port | direction | type | default | what |", "| --- | --- | --- | --- | --- |"]
        lines += [row(port) for port in node.ports]
        lines.append("")
    if node.since != "4.0":
        lines.append(f"BehaviorTree.CPP has it since {node.since}.\n")
    return "\n".join(lines)


def children(node: CatalogNode) -> str:
    """Returns the number of children that a node takes, in words."""
    low, high = node.min_children, node.max_children
    if high == 0:
        return ""
    if high is None:
        return f"Takes {low} or more children."
    return (
        f"Takes {low} {'child' if low == 1 else 'children'}."
        if low == high
        else f"Takes {low} to {high} children."
    )


def rule(node: CatalogNode) -> str:
    """The rule, from the docstring of the class, in Markdown."""
    first, _, text = (inspect.getdoc({**BUILT_IN, **ROS_NODES}[node.type]) or "").partition("\n\n")
    if first.rstrip(".") not in node.summary:
        text = f"{first}\n\n{text}"
    text = text.strip()
    return re.sub(r"``(.+?)``", r"`\1`", text)


def row(port: CatalogPort) -> str:
    """A port as a row of the table."""
    kind = " or ".join(port.enum) if port.enum else port.type
    default = "–" if port.default is None else f"`{port.default}`"
    return f"| `{port.name}` | {port.direction} | {kind} | {default} | {port.description} |"


def main() -> None:
    """Writes the page."""
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(page(), encoding="utf-8")


if __name__ == "__main__":
    main()
