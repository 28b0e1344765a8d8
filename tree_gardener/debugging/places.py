"""Names of nodes that outlast edits of the tree: the ids of the diagram, not paths and uids."""

from collections.abc import Sequence
from typing import NamedTuple

from tree_gardener.node import Node


class Place(NamedTuple):
    """A block of a BehaviorTree, in all instances of that tree or in one.

    Attributes:
        tree_id: the ID of the BehaviorTree.
        key: the block's id in the diagram; for a document without ids, the last part of the node's path.
        instance: the keys of the SubTree nodes that lead to the one instance, from the main tree on; None for
            all instances.
    """

    tree_id: str
    key: str
    instance: tuple[str, ...] | None = None


def place_of(node: Node, *, one_instance: bool = False) -> Place:
    """Returns the place of a node: in all instances of its tree, or in its own."""
    return Place(node.tree_id, key_of(node), instance_of(node) if one_instance else None)


def nodes_at(nodes: Sequence[Node], place: Place) -> list[Node]:
    """Returns the nodes at a place, in pre-order."""
    return [
        node
        for node in nodes
        if key_of(node) == place.key
        and node.tree_id == place.tree_id
        and (place.instance is None or instance_of(node) == place.instance)
    ]


def key_of(node: Node) -> str:
    """Returns the id of a node in its diagram, or the last part of its path."""
    return node.node_id or node.local_path


def instance_of(node: Node) -> tuple[str, ...]:
    """Returns the keys of the SubTree nodes round a node, from the main tree on."""
    keys: list[str] = []
    around = node.instance.subtree
    while around is not None:
        keys.append(key_of(around))
        around = around.instance.subtree
    return tuple(reversed(keys))
