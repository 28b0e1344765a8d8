"""Hooks, marks, clocks and counts round the ticks of nodes.

A hook before a node may return a result; the node is then not ticked. A hook after a node may replace its
result. Nodes without hooks are ticked exactly as in a tree without hooks.

Marks, clocks and counts are wanted in every session and every run in lock-step. Each is one small function
round the node's own, made when the tree is linked, and does only what was asked for.
"""

import dataclasses
import functools
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from tree_gardener.node import Execute, Leaf, Node
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.debugging.wiring import Wiring
    from tree_gardener.profiling import Profile
    from tree_gardener.tree import Tree

Before = Callable[[Node], Status | None]
After = Callable[[Node, Status], Status | None]


@dataclasses.dataclass(frozen=True, eq=False)
class Hook:
    """Functions to call before and after the ticks of one node, or of all (`uid` None)."""

    uid: int | None
    before: Before | None
    after: After | None


@dataclasses.dataclass(slots=True)
class ResultCount:
    """The number of ticks of a node by result; ticks that raised an exception are not counted."""

    success: int = 0
    failure: int = 0
    running: int = 0
    skipped: int = 0

    @property
    def ticks(self) -> int:
        """The number of ticks with a result."""
        return self.success + self.failure + self.running + self.skipped

    def add(self, status: Status) -> None:
        """Counts a result."""
        if status is SUCCESS:
            self.success += 1
        elif status is RUNNING:
            self.running += 1
        elif status is FAILURE:
            self.failure += 1
        else:
            self.skipped += 1


class Hooks:
    """The hooks of a tree.

    Attributes:
        marks_leaves: whether each leaf sets `Tree.current` while it is ticked.
        times_leaves: whether each leaf is also measured, for `Tree.slowest`.
        counts: the results of each node, in the order of the nodes, if they are counted.
        log: the uid and result of each tick of a node, in order, if they are logged.
        wiring: which nodes ask a debugger round their ticks, if one is attached.
        profile: measures each node, if one is attached.
    """

    def __init__(self, tree: "Tree") -> None:
        self.tree = tree
        self.hooks: list[Hook] = []
        self.marks_leaves = False
        self.times_leaves = False
        self.counts: list[ResultCount] | None = None
        self.log: list[tuple[int, Status]] | None = None
        self.wiring: Wiring | None = None
        self.profile: Profile | None = None

    @property
    def are_none(self) -> bool:
        """Whether no node has a hook of any kind."""
        is_free = not self.hooks and not self.marks_leaves and self.log is None and self.counts is None
        return is_free and self.wiring is None and self.profile is None and self.tree.node_times_s is None

    def entries(self, nodes: Sequence[Node]) -> list[Execute]:
        """Returns the functions that tick nodes together with their hooks."""
        if not self.are_none:
            return [node.entry() for node in nodes]
        return [node.execute if node.guard is None else node.execute_guarded for node in nodes]

    def entry(self, node: Node, inner: Execute) -> Execute:
        """Returns the function that ticks a node together with its hooks."""
        if self.are_none:
            return inner
        if self.has_debugger(node):
            inner = node.execute_guarded
        if self.tree.node_times_s is not None or self.has_hook(node):
            inner = functools.partial(self.run, node, inner)
        elif self.marks_leaves and isinstance(node, Leaf):
            inner = self._timed_leaf(node, inner) if self.times_leaves else self._marked_leaf(node, inner)
        if self.profile is not None:
            inner = self.profile.entry(node, inner)
        if self.wiring is not None:
            inner = self.wiring.entry(node, inner)
        if self.log is not None:
            inner = _logged(self.log, node.uid, inner)
        return inner if self.counts is None else _counted(self.counts[node.uid - 1], inner)

    def has_hook(self, node: Node) -> bool:
        """Returns whether a hook runs round the ticks of a node."""
        return bool(self.hooks) and any(hook.uid in (None, node.uid) for hook in self.hooks)

    def has_debugger(self, node: Node) -> bool:
        """Returns whether a node, or one below it, asks a debugger round its ticks."""
        return self.wiring is not None and self.wiring.reaches(node)

    def _marked_leaf(self, node: Node, inner: Execute) -> Execute:
        current, uid = self.tree.current, node.uid

        def execute() -> Status:
            current[0] = uid
            try:
                return inner()
            finally:
                current[0] = 0

        return execute

    def _timed_leaf(self, node: Node, inner: Execute) -> Execute:
        tree, clock = self.tree, time.perf_counter
        current, uid = tree.current, node.uid

        def execute() -> Status:
            current[0] = uid
            start_s = clock()
            try:
                status = inner()
            finally:
                current[0] = 0
            duration_s = clock() - start_s
            if duration_s > tree.slowest[0]:
                tree.slowest = (duration_s, uid)
            return status

        return execute

    def add(self, hook: Hook) -> Callable[[], None]:
        """Installs a hook; returns the function that removes it."""
        self.hooks.append(hook)
        self.tree.link_around(hook.uid)

        def remove() -> None:
            if hook in self.hooks:
                self.hooks.remove(hook)
                self.tree.link_around(hook.uid)

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
        is_leaf = self.marks_leaves and isinstance(node, Leaf)
        if times is None and not is_leaf:
            return inner()
        if is_leaf:
            tree.current[0] = node.uid
        start_s = time.perf_counter()
        try:
            status = inner()
        finally:
            if is_leaf:
                tree.current[0] = 0
        duration_s = time.perf_counter() - start_s
        if times is not None:
            times[node.uid] = times.get(node.uid, 0.0) + duration_s
        if is_leaf and self.times_leaves and duration_s > tree.slowest[0]:
            tree.slowest = (duration_s, node.uid)
        return status


def _counted(count: ResultCount, inner: Execute) -> Execute:
    """Counts the results of a node."""

    def execute() -> Status:
        status = inner()
        if status is SUCCESS:
            count.success += 1
        elif status is RUNNING:
            count.running += 1
        elif status is FAILURE:
            count.failure += 1
        else:
            count.skipped += 1
        return status

    return execute


def _logged(log: list[tuple[int, Status]], uid: int, inner: Execute) -> Execute:
    """Logs the results of a node."""
    add = log.append

    def execute() -> Status:
        status = inner()
        add((uid, status))
        return status

    return execute


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
