"""The events of the running tree and its blackboard: a part of the protocol in `executor.messages`."""

from __future__ import annotations

from typing import Any, Literal

from msgspec import Struct

NodeStatus = Literal["IDLE", "RUNNING", "SUCCESS", "FAILURE", "SKIPPED"]
PortEffect = Literal["next_tick", "next_start"]


class TreeNode(Struct):
    """One node of the running tree. `node_id` is its id in the diagram, `tree_id` the id of that diagram."""

    uid: int
    parent: int
    type: str
    kind: str
    name: str
    path: str
    node_id: str
    tree_id: str


class Tree(Struct):
    """The running tree, in pre-order; subtrees are expanded in place."""

    nodes: list[TreeNode]


class Tick(Struct):
    """The changes of one tick, or of a halt after it; a halt has the number `n` of that tick.

    `past` holds the nodes that are idle again, with their last status in the tick; it replaces the `past` of
    the previous message. `forced` holds the uids of the nodes whose result in the tick was forced.
    """

    n: int
    changed: list[tuple[int, NodeStatus]]
    flashed: list[tuple[int, NodeStatus]]
    duration_ms: float
    past: list[tuple[int, NodeStatus]] = []
    forced: list[int] = []


class BlackboardEntry(Struct):
    """One changed entry; a large value is sent as a preview (text), and `preview` is then true."""

    scope: str
    key: str
    type: str
    value: Any
    preview: bool = False
    removed: bool = False


class Blackboard(Struct):
    """Entries that changed since the previous message of this kind."""

    entries: list[BlackboardEntry]


class PortSet(Struct):
    """A port of a node of the running tree was given another text.

    `saved` is the text with which the tree was built; null stands for none. `effect` says when the node uses
    the new text: from the next tick on, or, because its action read the port only before the first tick, when
    the program starts again.
    """

    node_id: str
    tree_id: str
    path: str
    port: str
    value: str | None
    saved: str | None
    effect: PortEffect
