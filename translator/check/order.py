"""Finds keys that are read before anyone can have written them, in the order of execution.

A read comes too early if, in every run, the reading node is ticked before each of the nodes that write the
key. That is so if a reading node comes first, and none of the writers can be reached unless it was ticked:
`_Reader` follows it from its leaf to the root, and keeps for which results of each node the read is certain.
What a called tree reads so counts as a read of the SubTree node, under the name that it gives the key.
"""

from __future__ import annotations

from bisect import bisect_left
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from translator.check.results.certain import EVERY, first_guard, guarded, is_understood, lifted, needed
from translator.check.results.sets import RUNS, R
from translator.check.uses import is_local, outer_name
from translator.diagnostic import Step
from translator.tree import POST_CONDITIONS

if TYPE_CHECKING:
    from translator.check.context import Context
    from translator.tree import Node, Tree

_TRIED: Final = 4
"""The number of readers of a key that are followed; each comes before every writer."""
_WATCHES: Final = frozenset({"SkipUnlessUpdated", "WaitValueUpdate", "WasEntryUpdated"})
"""Nodes for which an entry without a value is no error."""


@dataclass(frozen=True, slots=True)
class _Early:
    """A key that a tree reads before it writes it.

    Attributes:
        results: the results of the tree's root for which the read is certain.
        path: the nodes from the root's caller down to the reader.
    """

    results: int
    port: str
    path: tuple[Step, ...]


@dataclass(slots=True)
class _Order:
    """A tree in the order of execution: the place of each node, and where its branch ends."""

    nodes: list[Node] = field(default_factory=list)
    place: dict[str, int] = field(default_factory=dict)
    end: dict[str, int] = field(default_factory=dict)
    parent: dict[str, tuple[Node, int]] = field(default_factory=dict)
    disabled: set[str] = field(default_factory=set)


def check_order(context: Context) -> None:
    """Reports each key that is read before it can have been written, at the node that reads it."""
    early: dict[str, dict[str, _Early]] = {}
    main = context.project.settings.main_tree
    for tree_id in context.order:
        if tree_id in context.reachable:
            tree = context.project.trees[tree_id]
            early[tree_id] = _Follower(context, tree, early, is_main=tree_id == main).follow()


class _Follower:
    """Looks at all keys of one tree."""

    def __init__(
        self, context: Context, tree: Tree, early: dict[str, dict[str, _Early]], *, is_main: bool
    ) -> None:
        self.context = context
        self.tree = tree
        self.early = early
        self.is_main = is_main
        self.order = _ordered(tree)
        self.readers: dict[str, list[tuple[int, str]]] = {}
        self.writers: dict[str, list[int]] = {}

    def follow(self) -> dict[str, _Early]:
        self.collect()
        found: dict[str, _Early] = {}
        for key, readers in self.readers.items():
            writers = self.writers.get(key, [])
            for place, port in readers[:_TRIED]:
                if writers and place > writers[0]:
                    break
                early = self.followed(key, place, port, writers)
                if early is None:
                    continue
                if not self.is_main and not is_local(self.context, self.tree, key):
                    found[key] = early
                elif writers:
                    self.report(key, place, early, writers)
                break
        return found

    def collect(self) -> None:
        """Finds the readers and writers of each key, in order."""
        parts = self.context.keys[self.tree.id].parts
        for place, node in enumerate(self.order.nodes):
            part = parts.get(node.id)
            if part is None:
                continue
            for key in part.written:
                self.writers.setdefault(self.name(key), []).append(place)
            if node.id in self.order.disabled:
                continue
            if node.is_subtree:
                for inner in self.early.get(node.tree, {}):
                    if (outer := outer_name(node, inner)) is not None:
                        self.readers.setdefault(self.name(outer), []).append((place, inner))
            elif node.type not in _WATCHES and not node.type.startswith("Switch"):
                for key, port in part.reads:
                    if port not in POST_CONDITIONS and key not in part.written:
                        self.readers.setdefault(self.name(key), []).append((place, port))

    def name(self, key: str) -> str:
        """Returns a key as the main tree knows it: `@key` is an entry of the main tree."""
        return key[1:] if self.is_main and key.startswith("@") else key

    def followed(self, key: str, place: int, port: str, writers: list[int]) -> _Early | None:
        """Returns the read if every writer comes after it in every run, else None."""
        node = self.order.nodes[place]
        path: tuple[Step, ...] = ()
        certain = EVERY
        if node.is_subtree:
            inner = self.early[node.tree][port]
            certain, path, port = inner.results, inner.path, inner.port
        here = Step(self.tree.id, node.id, node.label, (), "" if path else "reads", "" if path else key)
        # The first pre-condition is read before any can keep the node from being ticked.
        if path or port != first_guard(node):
            certain = guarded(node, certain)
        while (above := self.order.parent.get(node.id)) is not None:
            parent, index = above
            is_library = self.context.results.is_library(parent.type)
            if not is_understood(parent, is_library=is_library) or not self.is_before(
                parent, index, certain, writers
            ):
                return None
            sets = [self.context.results.of(self.tree, child) for child in parent.children]
            certain = guarded(parent, lifted(parent, index, sets, certain))
            node = parent
        return _Early(certain, port, (here, *path))

    def is_before(self, parent: Node, index: int, certain: int, writers: list[int]) -> bool:
        """Returns whether the later children of a node that write can be ticked only after the read."""
        end = self.order.end
        first = bisect_left(writers, end[parent.children[index]])
        if first == len(writers) or writers[first] >= end[parent.id]:
            return True
        results = self.context.results.of(self.tree, parent.children[index])
        results |= R if results & RUNS else 0
        for later in range(index + 1, len(parent.children)):
            child = parent.children[later]
            at = bisect_left(writers, self.order.place[child])
            if at < len(writers) and writers[at] < end[child]:
                wanted = needed(parent, index, later)
                if wanted is None or results & wanted & ~certain:
                    return False
        return True

    def report(self, key: str, place: int, early: _Early, writers: list[int]) -> None:
        writer = self.order.nodes[writers[0]]
        if writers[0] == place:  # the called tree itself writes it later
            path = early.path
        else:
            path = (*early.path, Step(self.tree.id, writer.id, writer.label, (), "writes", key))
        reader = self.order.nodes[place]
        port = early.port if len(early.path) == 1 else ""
        said = {"key": key, "reader": early.path[-1].label, "writer": writer.label}
        self.context.report("BT0405", self.tree, reader, port, path, **said)


def _ordered(tree: Tree) -> _Order:
    order = _Order()
    order.nodes = list(tree.walk())
    for place, node in enumerate(order.nodes):
        order.place[node.id] = place
        for index, child in enumerate(node.children):
            order.parent[child] = node, index
        above = order.parent.get(node.id)
        if node.disabled or (above is not None and above[0].id in order.disabled):
            order.disabled.add(node.id)
    for node in reversed(order.nodes):
        last = node.children[-1] if node.children else None
        order.end[node.id] = order.end[last] if last in order.end else order.place[node.id] + 1
    return order
