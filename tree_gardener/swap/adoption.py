"""Gives a tree that has not ticked yet the state of another one."""

from collections.abc import Mapping
from typing import Any

from tree_gardener.blackboard import EMPTY, Entry
from tree_gardener.clock import Timer
from tree_gardener.controls.custom import CustomControl
from tree_gardener.leaves.behaviour import BehaviourLeaf
from tree_gardener.loader import bound_ports
from tree_gardener.node import Node
from tree_gardener.rebind import rebind
from tree_gardener.status import IDLE
from tree_gardener.swap.capturing import capture, scopes_of
from tree_gardener.swap.memory import count_done, give
from tree_gardener.swap.plan import moved_entries
from tree_gardener.swap.state import Due, Key, NodeState, TreeState, keys_of
from tree_gardener.tree import Tree


def adopt(tree: Tree, state: TreeState, behaviours: Mapping[Key, Any], made: TreeState | None = None) -> None:
    """Gives a tree the state of another one: statuses, memory, timers, blackboard and the number of ticks.

    Nodes are found by key and type; the others begin IDLE. A node that has another parent than before keeps
    its memory and is IDLE.

    Args:
        tree: a tree that has not ticked yet, with the clock of the other.
        state: the state of the other tree.
        behaviours: the user's objects that continue, by the key of their node; each takes the place of the
            object that was made with the tree.
        made: the state of the tree when it was made, if it is known.
    """
    new = capture(tree, made)
    keys = keys_of(tree.nodes)
    due: list[tuple[Due, Node, str]] = []
    for node in tree.nodes:
        key = keys[node.uid]
        before, after = state.nodes.get(key), new.nodes[key]
        if before is None or before.kind != after.kind:
            continue
        node.status = before.status if before.parent == after.parent else IDLE
        due += [(timer, node, name) for timer, name in give(node, before, after.children)]
        if isinstance(node, (BehaviourLeaf, CustomControl)) and key in behaviours:
            move_in(node, behaviours[key], before)
    for node in tree.nodes:
        count_done(node)
    _start(tree, due)
    _fill(tree, state, new)
    uids = {key: uid for uid, key in keys.items()}
    tree.warned = {(uids[key], sentence) for key, sentence in state.warned if key in uids}
    tree.wake_up = state.woken
    tree.continue_at(state.tick)
    tree.link()


def move_in(node: BehaviourLeaf | CustomControl, behaviour: Any, before: NodeState) -> None:
    """Makes a user's object that of another node. It reads and writes the ports of this node from now on."""
    earlier: Node = behaviour.tree_gardener_node
    if node.bound is not None and earlier.bound is not None:
        earlier.bound.replace(bound_ports(node))
        node.bound = earlier.bound
    node.early = before.early
    behaviour.tree_gardener_node = node
    node.bind(behaviour)
    rebind(behaviour)


def _start(tree: Tree, due: list[tuple[Due, Node, str]]) -> None:
    """Schedules the timers of nodes."""
    for timer, node, name in due:
        assert timer.order is not None  # it has not fired
        started = Timer(timer.at_s, node.fire)  # type: ignore[attr-defined]
        tree.timers.restore(started, timer.order)
        setattr(node, name, started)


def _fill(tree: Tree, state: TreeState, new: TreeState) -> None:
    """Writes the entries of the other tree, with their types and numbers of writes."""
    scopes = scopes_of(tree, keys_of(tree.nodes))
    for scope, key, held in moved_entries(state, new):
        board = scopes[scope]
        entry = board.entries.get(key)
        if entry is None:
            entry = board.entries[key] = Entry(board, key, held.type)
        kind = entry.type
        if kind is None or not kind.is_strong:
            entry.type, entry.value = held.type or kind, held.value
        else:
            is_same = held.value is EMPTY or kind is held.type
            entry.value = held.value if is_same else kind.convert(held.value)
        entry.sequence = held.sequence
