"""Views for py_trees' tools: composites and decorators of py_trees that represent nodes of the engine.

They are made at the first request, so that a tree without py_trees' tools does not pay for them. Actions are
their own views. The root's `tick` is a generator, as py_trees requires: it ticks the tree and then yields
every node that took part, with the status that it returned, children before their parents.
"""

from collections.abc import Iterator
from typing import Any, Final

import py_trees

from tree_gardener.node import Kind, Node
from tree_gardener.observe import TickChanges
from tree_gardener.status import IDLE, Status, to_py_trees

_SEQUENCES: Final = frozenset(
    ("Sequence", "AsyncSequence", "SequenceWithMemory", "ReactiveSequence", "TryCatch")
)
_PARALLELS: Final = frozenset(("Parallel", "ParallelAll"))


class _View:
    """The base of all views."""

    node: Node
    children: list[Any]
    parent: Any
    status: Any
    name: str

    def adopt(self, node: Node) -> None:
        """Makes this view the py_trees object of a node."""
        self.node = node
        self.children = [child.view if child.view is not None else child.behaviour for child in node.children]
        for child in self.children:
            child.parent = self
        self.qualified_name = f"{node.type}/{node.name}"

    def update(self) -> Any:
        """Returns the node's status; the engine ticks the node, not py_trees."""
        return to_py_trees(self.node.status)

    def tick(self) -> Iterator[Any]:
        """Ticks the whole tree if this is its root; yields the nodes that took part."""
        if self.node.parent is not None:
            yield self
            return
        yield from _tick(self.node)

    def tick_once(self) -> None:
        """Ticks the whole tree if this is its root."""
        for _ in self.tick():
            pass

    def stop(self, new_status: Any = py_trees.common.Status.INVALID) -> None:
        """Halts the tree, if this is its root."""
        if self.node.parent is None and new_status == py_trees.common.Status.INVALID:
            self.node.tree.halt()
            sync(self.node)


class SequenceView(_View, py_trees.composites.Sequence):
    """A node that continues while its children succeed."""


class SelectorView(_View, py_trees.composites.Selector):
    """A node that chooses among its children."""


class ParallelView(_View, py_trees.composites.Parallel):
    """A node that ticks its children together."""


class DecoratorView(_View, py_trees.decorators.Decorator):
    """A node with one child."""


class LeafView(_View, py_trees.behaviour.Behaviour):
    """A built-in node without children."""


def view_of(node: Node) -> Any:
    """Returns the py_trees object of a node; the first call makes the views of the whole tree."""
    nodes = node.tree.nodes
    if nodes[0].view is None:
        # Children before parents, without recursion.
        for each in reversed(nodes):
            each.view = _make(each)
    sync(nodes[0])
    return node.view


def _make(node: Node) -> Any:
    if not node.children and (behaviour := getattr(node, "instance_behaviour", None)) is not None:
        return behaviour
    view: Any
    if node.type in _SEQUENCES:
        view = SequenceView(node.name, memory=not node.type.startswith("Reactive"), children=[])
    elif node.type in _PARALLELS:
        view = ParallelView(node.name, policy=py_trees.common.ParallelPolicy.Base(), children=[])
    elif node.kind == Kind.CONTROL.value:
        view = SelectorView(node.name, memory=not node.type.startswith("Reactive"), children=[])
    elif node.children:
        placeholder = LeafView(node.name)
        view = DecoratorView(node.name, placeholder)
    else:
        view = LeafView(node.name)
    view.adopt(node)
    return view


def sync(root: Node, results: dict[int, Status] | None = None) -> None:
    """Updates the statuses of the views; results of the tick override the nodes' own statuses."""
    for node in root.tree.nodes:
        status = node.status
        if results is not None and status is IDLE:
            status = results.get(node.uid, IDLE)
        node.view.status = to_py_trees(status)


def _tick(root: Node) -> Iterator[Any]:
    tree = root.tree
    results: dict[int, Status] = {}

    def record(node: Node, status: Status) -> None:
        results[node.uid] = status

    remove = tree.add_hook(after=record)
    try:
        tree.tick_exactly_once()
    finally:
        remove()
    sync(root, results)
    for uid in results:
        yield tree.nodes[uid - 1].view


def describe_changes(changes: TickChanges, tree: Any) -> str:
    """Returns the changes of a tick as one line for a log: paths and statuses."""
    nodes = tree.nodes
    both = [*changes.flashed, *changes.changed]
    return ", ".join(f"{nodes[uid - 1].path} {status.name}" for uid, status in both) or "no change"
