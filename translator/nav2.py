"""Nodes of Nav2 in an imported tree: their sources if the engine has them, else their ports for a stub."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from translator.action_kind import LIMITS
from translator.catalog import NodeModel, PortModel

if TYPE_CHECKING:
    from collections.abc import Mapping, Set

# A single name, such as IsStuck, may be anyone's node.
LEAST_NODES: Final = 2
_TYPES: Final = {
    "double": "double",
    "float": "double",
    "bool": "bool",
    "string": "string",
    "int": "int",
    "uint16": "int",
    "unsigned int": "int",
    "chrono::milliseconds": "int",
    "vector<int>": "list[int]",
    "vector<string>": "list[string]",
}


def nav2_models(seen: Mapping[str, Set[str]], models: Mapping[str, NodeModel]) -> dict[str, NodeModel]:
    """Returns the models of those nodes of a tree that are nodes of Nav2.

    Args:
        seen: The ports with which each type of node is used.
        models: The models in the document; a model that differs from Nav2's belongs to another node.
    """
    from tree_gardener.nav2_library import table  # noqa: PLC0415 - the engine loads py_trees

    rows = table()
    found = {type_: _model(rows[type_]) for type_ in seen if type_ in rows}
    if len(found) < LEAST_NODES:
        return {}
    return {
        type_: model
        for type_, model in found.items()
        if seen[type_] <= model.ports.keys() and _agrees(model, models.get(type_))
    }


def nav2_source(type_: str) -> str | None:
    """Returns the source of a node of Nav2; None if it needs an action or a service of ROS."""
    from tree_gardener.nav2_library import source_of  # noqa: PLC0415 - as above

    return source_of(type_)


def _agrees(model: NodeModel, own: NodeModel | None) -> bool:
    return own is None or (own.kind == model.kind and own.ports.keys() <= model.ports.keys())


def _model(row: dict[str, Any]) -> NodeModel:
    ports = {
        port["name"]: PortModel(
            name=port["name"],
            direction=port["direction"],
            type=_TYPES.get(port["type"], "any"),
            default=port.get("default"),
            description=port["description"],
        )
        for port in row["ports"]
    }
    low, high = LIMITS.get(row["kind"], (0, 0))
    return NodeModel(row["type"], row["kind"], low, high, ports)
