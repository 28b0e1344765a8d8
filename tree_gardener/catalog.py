"""The table of the built-in nodes, `catalog.json`, which all parts of BT Studio use."""

import dataclasses
import functools
import json
import pathlib
from typing import Any, Final

from tree_gardener.ports import NO_DEFAULT, PortSpec
from tree_gardener.values import queue_type, value_type

PATH: Final = pathlib.Path(__file__).with_name("catalog.json")


@dataclasses.dataclass(frozen=True)
class CatalogPort:
    """A port of a built-in node; `default` is None if there is none."""

    name: str
    direction: str
    type: str
    default: str | None
    required: bool
    description: str
    enum: tuple[str, ...] = ()


@dataclasses.dataclass(frozen=True)
class CatalogNode:
    """A built-in node; `max_children` is None if there may be any number.

    `group` is ``ros`` for nodes that BehaviorTree.CPP has not. An `open` node takes more ports than its own.
    """

    type: str
    kind: str
    symbol: str
    min_children: int
    max_children: int | None
    ports: tuple[CatalogPort, ...]
    summary: str
    since: str
    group: str = ""
    open: bool = False

    @functools.cached_property
    def manifest(self) -> dict[str, PortSpec]:
        """Returns the ports of the node in the engine's form."""
        return {port.name: _spec(port) for port in self.ports}


def _spec(port: CatalogPort) -> PortSpec:
    default: Any = NO_DEFAULT if port.default is None else port.default
    # Built-in nodes miss their ports when they are ticked, as in BT.CPP, never at load.
    # The queue of a Loop fixes no type of its entry: a list or a text may be there, too.
    is_queue = port.name == "queue" and port.type.startswith("list[")
    kind = queue_type(port.type[len("list[") : -1]) if is_queue else value_type(port.type)
    return PortSpec(port.name, port.direction, kind, default, description=port.description)


@functools.cache
def load() -> dict[str, CatalogNode]:
    """Returns the built-in nodes by type, in the order of the catalogue."""
    nodes = json.loads(PATH.read_text(encoding="utf-8"))["nodes"]
    return {node["type"]: _node(node) for node in nodes}


def _node(node: dict[str, Any]) -> CatalogNode:
    ports = tuple(CatalogPort(**{**port, "enum": tuple(port.get("enum", ()))}) for port in node["ports"])
    return CatalogNode(
        type=node["type"],
        kind=node["kind"],
        symbol=node["symbol"],
        min_children=node["children"]["min"],
        max_children=node["children"]["max"],
        ports=ports,
        summary=node["summary"],
        since=node["since"],
        group=node.get("group", ""),
        open=node.get("open", False),
    )
