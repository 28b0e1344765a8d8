"""The built-in nodes, read from the engine's catalogue."""

from __future__ import annotations

import json
from dataclasses import dataclass, fields, replace
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


@dataclass(frozen=True, slots=True)
class PortModel:
    """A port of a kind of node.

    `type` is a name of the catalogue (int, double, list[int], …), an enumeration with its names
    (Color[RED;GREEN]), or `any`. `named` is the name of a type that the source gives as text and that is not
    in the catalogue; it may be an enumeration of the project. `is_object`: the type is a class of the user's.
    """

    name: str
    direction: str = "input"
    type: str = "any"
    default: str | None = None
    required: bool = False
    description: str = ""
    named: str = ""
    is_object: bool = False

    @property
    def is_read(self) -> bool:
        """Whether the node reads the port."""
        return self.direction != "output"

    @property
    def is_written(self) -> bool:
        """Whether the node writes the port."""
        return self.direction != "input"


@dataclass(frozen=True, slots=True)
class NodeModel:
    """A kind of node: control, decorator, action, condition or subtree; its ports and child counts.

    `group` is `ros` for built-in nodes that BehaviorTree.CPP does not have.
    """

    type: str
    kind: str
    min_children: int
    max_children: int | None
    ports: Mapping[str, PortModel]
    open: bool = False
    summary: str = ""
    since: str = "4.0"
    group: str = ""


@cache
def builtins() -> Mapping[str, NodeModel]:
    """Returns the built-in nodes by type."""
    document = json.loads(
        resources.files("tree_gardener").joinpath("catalog.json").read_text(encoding="utf-8")
    )
    return {row["type"]: _node_model(row) for row in document["nodes"]}


def _node_model(row: dict[str, object]) -> NodeModel:
    children = row["children"]
    ports = row["ports"]
    assert isinstance(children, dict)  # noqa: S101 - the catalogue is ours
    assert isinstance(ports, list)  # noqa: S101
    return NodeModel(
        type=str(row["type"]),
        kind=str(row["kind"]),
        min_children=children["min"],
        max_children=children["max"],
        ports={port["name"]: _port_model(port) for port in ports},
        open=bool(row.get("open", False)),
        summary=str(row["summary"]),
        since=str(row["since"]),
        group=str(row.get("group", "")),
    )


def _port_model(row: dict[str, Any]) -> PortModel:
    port = PortModel(**{field.name: row[field.name] for field in fields(PortModel) if field.name in row})
    if port.type == "string" and "enum" in row:  # for the engine a string, for the editor a choice
        return replace(port, type=f"{port.name}[{';'.join(row['enum'])}]")
    return port


def did_you_mean(name: str, known: Iterable[str], *, otherwise: str = "") -> str:
    """Returns the sentence that suggests the nearest known name; `otherwise` if there is none."""
    near = nearest(name, known)
    return f"Did you mean {near}?" if near else otherwise


def nearest(name: str, known: Iterable[str]) -> str:
    """Returns the known name that is most similar to this one; "" if there is none."""
    # Imported here, since the engine imports py_trees, which reading and writing trees do not need.
    from tree_gardener.spelling import nearest as nearest_name  # noqa: PLC0415

    return nearest_name(name, known)
