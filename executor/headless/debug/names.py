"""Finds the nodes that a user names: by uid, path, name or type."""

from __future__ import annotations

from typing import TYPE_CHECKING

from executor.headless.debug.words import whole
from tree_gardener.debugging import place_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from tree_gardener.debugging import Place
    from tree_gardener.node import Node

MOST_LISTED = 8


class UnknownNodeError(ValueError):
    """No node, or more than one, has the name; the text says which ones have."""


def place_named(nodes: Sequence[Node], name: str) -> Place:
    """Returns the block that a name means: at one instance if a path names it, else at all instances.

    Raises:
        UnknownNodeError: no block has this name, or several have.
    """
    found = _nodes(nodes, name)
    places = {place_of(node) for node in found}
    if len(places) > 1:
        raise _ambiguous(name, found)
    is_one = len(found) == 1 and len(_nodes_at(nodes, found[0])) > 1
    return place_of(found[0], one_instance=is_one)


def node_named(nodes: Sequence[Node], name: str) -> Node:
    """Returns the one node that a name means.

    Raises:
        UnknownNodeError: no node has this name, or several have.
    """
    found = _nodes(nodes, name)
    if len(found) > 1:
        raise _ambiguous(name, found)
    return found[0]


def names_of(nodes: Sequence[Node]) -> list[str]:
    """Returns the names for completion: all paths, and all names without a path."""
    return sorted({word for node in nodes for word in (node.path, node.name)})


def _nodes(nodes: Sequence[Node], name: str) -> list[Node]:
    number = whole(name.removeprefix("#"))
    if number is not None and 0 < number <= len(nodes):
        return [nodes[number - 1]]
    for attribute in ("path", "name", "type"):
        found = [node for node in nodes if getattr(node, attribute) == name]
        if found:
            return found
    raise UnknownNodeError(f"no node has the path, name or type '{name}'; `tree` lists all nodes")


def _nodes_at(nodes: Sequence[Node], node: Node) -> list[Node]:
    place = place_of(node)
    return [each for each in nodes if place_of(each) == place]


def _ambiguous(name: str, found: Sequence[Node]) -> UnknownNodeError:
    listed = ", ".join(f"#{node.uid} {node.path}" for node in found[:MOST_LISTED])
    more = f" and {len(found) - MOST_LISTED} more" if len(found) > MOST_LISTED else ""
    return UnknownNodeError(
        f"{len(found)} nodes are called '{name}': {listed}{more}; name one by its number or path"
    )
