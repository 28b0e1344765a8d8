"""Reads the state of a tree between two ticks."""

from collections.abc import Mapping
from typing import Any

from tree_gardener.controls.custom import CustomControl
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.node import Node
from tree_gardener.swap.memory import taken
from tree_gardener.swap.state import EntryState, Key, NodeState, TreeState, keys_of
from tree_gardener.tree import Tree


def capture(tree: Tree, before: TreeState | None = None) -> TreeState:
    """Returns the state of a tree.

    Values of the blackboard and queues are not copied: they are the objects that the tree uses.

    Args:
        tree: the tree.
        before: an earlier state of it, since which no node has changed: they are not read again.

    Raises:
        RuntimeError: a tick is in progress.
    """
    if tree.is_ticking:
        raise RuntimeError("the state of a tree is captured between two ticks")
    keys = keys_of(tree.nodes)
    scopes = scopes_of(tree, keys)
    return TreeState(
        tick=tree.tick_number,
        woken=tree.wake_up,
        nodes=_nodes(tree, keys) if before is None else before.nodes,
        entries={
            scope: {
                key: EntryState(entry.type, entry.value, entry.sequence)
                for key, entry in board.entries.items()
            }
            for scope, board in scopes.items()
        },
        remapped={scope: frozenset(board.remapping) for scope, board in scopes.items()},
        warned=frozenset((keys[uid], sentence) for uid, sentence in tree.warned),
    )


def scopes_of(tree: Tree, keys: Mapping[int, Key]) -> dict[Key, Any]:
    """Returns the scopes of the blackboard by the key of their SubTree node; () is the root."""
    scopes: dict[Key, Any] = {(): tree.blackboard}
    for node in tree.nodes:
        around = node.instance.subtree
        if around is not None:
            scopes[keys[around.uid]] = node.instance.board
    return scopes


def behaviour_of(node: Node) -> Any:
    """Returns the user's object of a node; None for a built-in node."""
    if isinstance(node, BehaviourLeaf):
        return node.instance_behaviour
    if isinstance(node, CustomControl):
        return node.owner
    return None


def _nodes(tree: Tree, keys: Mapping[int, Key]) -> dict[Key, NodeState]:
    orders = {id(timer): order for _, order, timer in tree.timers.heap if timer.callback is not None}
    return {keys[node.uid]: _node(node, keys, orders) for node in tree.nodes}


def _node(node: Node, keys: Mapping[int, Key], orders: Mapping[int, int]) -> NodeState:
    children = tuple(keys[child.uid] for child in node.children)
    return NodeState(
        path=node.path,
        kind=node.type,
        tree_id=node.tree_id,
        code=type(node.instance_behaviour) if isinstance(node, (BehaviourLeaf, CustomControl)) else None,
        status=node.status,
        parent=None if node.parent is None else keys[node.parent.uid],
        children=children,
        attributes=dict(node.attributes),
        memory=taken(node, children, orders),
        early=node.early - node.ports_read,
    )
