"""The state of a tree between two ticks, as data that names nodes by key and holds no node."""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

from tree_gardener.node import Node
from tree_gardener.status import Status
from tree_gardener.values import ValueType

Key = tuple[str, ...]
"""The ids of the SubTree nodes around a node, from the outermost, and its own id."""


@dataclasses.dataclass(frozen=True)
class Due:
    """A timer of a node.

    Attributes:
        at_s: its deadline, in seconds of the tree's clock.
        order: its place among timers with the same deadline; None if it has fired.
    """

    at_s: float
    order: int | None


@dataclasses.dataclass(frozen=True)
class NodeState:
    """The state of one node.

    Attributes:
        path: its path, for people.
        kind: its type, as the tag in XML.
        tree_id: the ID of the BehaviorTree of which it is a part.
        code: the class of the user's code; None for a built-in node.
        status: its stored status; never SKIPPED.
        parent: the key of its parent; None for the root.
        children: the keys of its children, in order.
        attributes: its attributes in XML.
        memory: its counts, latches, timers and queues, and its current child by key.
        early: the ports that the user's code read before the first tick, and not since.
    """

    path: str
    kind: str
    tree_id: str
    code: type[Any] | None
    status: Status
    parent: Key | None
    children: tuple[Key, ...]
    attributes: Mapping[str, str]
    memory: Mapping[str, Any]
    early: frozenset[str]


@dataclasses.dataclass(frozen=True)
class EntryState:
    """One entry of the blackboard: its declared type (None: any), its value, and the number of writes."""

    type: ValueType | None
    value: Any
    sequence: int


@dataclasses.dataclass(frozen=True)
class TreeState:
    """The state of a tree between two ticks.

    Attributes:
        tick: the number of ticks so far.
        woken: whether a node asked for another tick soon.
        nodes: the nodes, in pre-order.
        entries: the entries by scope, which is the key of its SubTree node, () for the root.
        remapped: for each scope the names that lead to an entry of the caller.
        warned: the warnings that were given, by node.
    """

    tick: int
    woken: bool
    nodes: Mapping[Key, NodeState]
    entries: Mapping[Key, Mapping[str, EntryState]]
    remapped: Mapping[Key, frozenset[str]]
    warned: frozenset[tuple[Key, str]]


def keys_of(nodes: Sequence[Node]) -> dict[int, Key]:
    """Returns the key of each node by uid.

    A node without the id of a diagram's node is known by its type and name. Equal ones are numbered, in
    pre-order.
    """
    keys: dict[int, Key] = {}
    seen: dict[Key, int] = {}
    for node in nodes:  # in pre-order, so that the SubTree node is known before its body
        around = node.instance.subtree
        scope = () if around is None else keys[around.uid]
        local = node.node_id or f"{node.type} {node.attributes.get('name', '')}"
        key = (*scope, local)
        count = seen[key] = seen.get(key, 0) + 1
        keys[node.uid] = key if count == 1 else (*scope, f"{local} #{count}")
    return keys
