"""Hooks before and after the ticks of nodes: for debuggers, tests and timing.

A hook before a node may return a result; the node is then not ticked. A hook after a node may replace its
result. Nodes without hooks are ticked exactly as in a tree without hooks.
"""

import dataclasses
import time
from collections.abc import Callable
from typing import TYPE_CHECKING

from tree_gardener.node import Execute, Leaf, Node
from tree_gardener.status import IDLE, RUNNING, SKIPPED, Status

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

Before = Callable[[Node], Status | None]
After = Callable[[Node, Status], Status | None]


@dataclasses.dataclass(frozen=True, eq=False)
class Hook:
    """Functions to call before and after the ticks of one node, or of all (`uid` None)."""

    uid: int | None
    before: Before | None
    after: After | None


class Hooks:
    """The hooks of a tree."""

    def __init__(self, tree: "Tree") -> None:
        self.tree = tree
        self.hooks: list[Hook] = []
        self.times_leaves = False

    def applies(self, node: Node) -> bool:
        """Returns whether a node must be ticked with hooks."""
        if self.tree.node_times_s is not None or (self.times_leaves and isinstance(node, Leaf)):
            return True
        return any(hook.uid in (None, node.uid) for hook in self.hooks)

    def add(self, hook: Hook) -> Callable[[], None]:
        """Installs a hook; returns the function that removes it."""
        self.hooks.append(hook)
        self.tree.link()

        def remove() -> None:
            if hook in self.hooks:
                self.hooks.remove(hook)
                self.tree.link()

        return remove

    def run(self, node: Node, inner: Execute) -> Status:
        """Ticks a node with its hooks."""
        hooks = [hook for hook in self.hooks if hook.uid in (None, node.uid)]
        for hook in hooks:
            replaced = hook.before(node) if hook.before is not None else None
            if replaced is not None:
                return _take(node, replaced)
        status = self.timed(node, inner)
        for hook in hooks:
            replaced = hook.after(node, status) if hook.after is not None else None
            if replaced is not None and replaced is not status:
                status = _take(node, replaced)
        return status

    def timed(self, node: Node, inner: Execute) -> Status:
        """Ticks a node, and measures its time if an observer requested times."""
        tree = self.tree
        times = tree.node_times_s
        is_leaf = self.times_leaves and isinstance(node, Leaf)
        if times is None and not is_leaf:
            return inner()
        if is_leaf:
            tree.current[0] = node.uid
        start_s = time.perf_counter()
        status = inner()
        duration_s = time.perf_counter() - start_s
        if times is not None:
            times[node.uid] = times.get(node.uid, 0.0) + duration_s
        if is_leaf:
            tree.current[0] = 0
            if duration_s > tree.slowest[0]:
                tree.slowest = (duration_s, node.uid)
        return status


def _take(node: Node, status: Status) -> Status:
    """Sets the status of a node to the result that a hook decided."""
    if status is IDLE:
        raise ValueError("a hook must not return IDLE")
    if status is SKIPPED:
        return node.skipped()
    if status is RUNNING:
        if node.status is not RUNNING:
            node.start()
        return RUNNING
    if node.status is RUNNING:
        # Nodes below it must not stay RUNNING under a node that is done.
        node.halt()
    return node.complete(status)
