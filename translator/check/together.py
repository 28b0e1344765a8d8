"""Checks branches that run at the same time: their writes and commands, and which of them may be RUNNING."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from translator.check.commands import MOVERS, VELOCITY, commanded_by, commanded_by_block
from translator.check.reason import step
from translator.check.results.controls import FALLBACKS, SEQUENCES, ordered
from translator.check.results.decorators import of_decorator
from translator.check.results.resumed import resumed
from translator.check.results.sets import ALL, RUNS, YIELDS, F, K, R, S
from translator.diagnostic import Step

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from translator.check.context import Context
    from translator.tree import Node, Tree

_PARALLEL: Final = frozenset({"Parallel", "ParallelAll"})
_NAV2: Final = {"NonblockingSequence": S | R | YIELDS, "PipelineSequence": ALL & ~F | YIELDS}
_REACTIVE: Final = {"ReactiveSequence": S | K, "ReactiveFallback": F | K}
_COMPARED: Final = 64
"""The number of branches of a node that are compared with each other."""


def check_together(context: Context) -> None:
    """Reports conflicts between two branches that can run at the same time."""
    topics = _Topics(context)
    roots: dict[str, int] = {}
    for tree_id in context.order:
        tree = context.project.trees[tree_id]
        topics.read(tree)
        later = resumed(tree, context.results, roots)
        roots[tree_id] = later.get(tree.root or "", 0)
        for node in tree.walk():
            if len(node.children) < 2 or node.disabled:
                continue
            if node.type in _PARALLEL:
                _check_keys(context, tree, node)
            if node.type in _REACTIVE:
                _check_running(context, tree, node, later)
            topics.check(tree, node)


def _check_running(context: Context, tree: Tree, node: Node, later: Mapping[str, int]) -> None:
    """Reports a child of a reactive node that waits, and then lets another one wait: it starts again.

    Each tick begins at the first child. One that was RUNNING, and has continued to another that is RUNNING,
    is reset: at the next tick it is RUNNING again, and the other is halted.
    """
    first: Node | None = None
    for child in node.children:
        if not context.results.named_of(tree, child) & R:
            continue
        if first is not None:
            second = tree.nodes[child]
            steps = tuple(step(context, tree, each) for each in (node, first, second))
            said = {"node": node.label, "first": first.label, "second": second.label}
            context.report("BT0121", tree, second, "", steps, **said)
            return
        if later[child] & _REACTIVE[node.type] & ~K:
            first = tree.nodes[child]


def _check_keys(context: Context, tree: Tree, node: Node) -> None:
    """Reports a key that two branches of a parallel node write."""
    parts = context.keys[tree.id].parts
    written: dict[str, tuple[str, Node]] = {}
    told: set[str] = set()
    for branch in node.children:
        for each in tree.walk(branch):
            part = parts.get(each.id)
            for key in part.surely & part.written.keys() if part is not None else ():
                before = written.setdefault(key, (branch, each))
                if before[0] == branch or key in told:
                    continue
                told.add(key)
                both = (before[1], each)
                steps = (
                    step(context, tree, node),
                    *(Step(tree.id, one.id, one.label, (), "writes", key) for one in both),
                )
                said = {"key": key, "node": node.label, "first": both[0].label, "second": each.label}
                context.report("BT0406", tree, each, "", steps, **said)


class _Topics:
    """The topics that the branches of all trees command, each with the leaf that does so first."""

    def __init__(self, context: Context) -> None:
        self.context = context
        self.types: dict[str, frozenset[str]] = {}
        self.roots: dict[str, dict[str, tuple[Step, ...]]] = {}
        self.own: dict[str, dict[str, tuple[Step, ...]]] = {}
        self.branches: dict[str, dict[str, dict[str, str]]] = {}
        self.commanded: dict[str, dict[str, int]] = {}

    def read(self, tree: Tree) -> None:
        """Finds the topics of each branch of a tree: by topic, the id of the first node that commands it."""
        self.own = {}
        branches: dict[str, dict[str, str]] = {}
        for node in tree.post_order():
            found: dict[str, str] = {}
            if not node.disabled:
                for child in reversed(node.children):
                    found.update(branches.get(child, {}))
                if not node.children:
                    for topic, path in self.leaf(tree, node):
                        found[topic] = node.id
                        self.own.setdefault(node.id, {})[topic] = path
            if found:
                branches[node.id] = found
        self.branches[tree.id] = branches
        first = branches.get(tree.root or "", {})
        self.roots[tree.id] = {topic: self.own[node][topic] for topic, node in first.items()}
        self.commanded[tree.id] = {topic: self.after(tree, tree.root or "", topic) for topic in first}

    def leaf(self, tree: Tree, node: Node) -> Iterator[tuple[str, tuple[Step, ...]]]:
        """Yields the topics of a leaf or of a SubTree, with the path to the leaf that commands them."""
        if node.is_subtree:
            for topic, path in self.roots.get(node.tree, {}).items():
                yield topic, (Step(tree.id, node.id, node.label), *path)
            return
        for topic in sorted(self.of_type(node.type) or commanded_by_block(node)):
            yield topic, (Step(tree.id, node.id, node.label, (), "commands", topic),)

    def of_type(self, type_: str) -> frozenset[str]:
        found = self.types.get(type_)
        if found is None:
            action = self.context.project.actions.get(type_)
            found = commanded_by(action) if action is not None else frozenset()
            if self.context.results.is_library(type_) and type_ in MOVERS:
                found = frozenset((VELOCITY,))
            self.types[type_] = found
        return found

    def check(self, tree: Tree, node: Node) -> None:
        """Reports two branches of a node that can command the same topic in the same tick."""
        branches = self.branches[tree.id]
        topics: dict[str, list[str]] = {}
        for branch in node.children[:_COMPARED]:
            for topic, leaf in branches.get(branch, {}).items():
                before = topics.setdefault(topic, [])
                for other in before:
                    if self.are_together(tree, node, other, branch, topic):
                        self.report(tree, node, topic, branches[other][topic], leaf)
                        return
                before.append(branch)

    def are_together(self, tree: Tree, node: Node, first: str, second: str, topic: str) -> bool:
        """Returns whether a tick can reach both branches, after the first one's command."""
        if node.type in _PARALLEL:
            return True
        passes = _REACTIVE.get(node.type)
        if node.type in _NAV2 and self.context.results.is_library(node.type):
            passes = _NAV2[node.type]
        if node.type == "WhileDoElse" and first == node.children[0]:
            passes = S if second == node.children[1] else F
        if passes is None:
            return False
        runs = self.context.results.named_of(tree, second) & RUNS
        return bool(runs and self.after(tree, first, topic) & passes)

    def after(self, tree: Tree, branch: str, topic: str) -> int:
        """Returns the results that a branch can have in a tick in which it commanded a topic."""
        leaf = self.branches[tree.id][branch][topic]
        above = [branch]
        while above[-1] != leaf:
            children = tree.nodes[above[-1]].children
            above.append(next(child for child in children if self.first(tree, child, topic) == leaf))
        node = tree.nodes[leaf]
        inside = self.commanded.get(node.tree, {}) if node.is_subtree else {}
        result = inside.get(topic, self.context.results.named_of(tree, leaf))
        for node_id, child in zip(above[-2::-1], above[:0:-1], strict=True):
            result = self.lifted(tree, tree.nodes[node_id], child, result)
        return result

    def first(self, tree: Tree, branch: str, topic: str) -> str | None:
        """Returns the first leaf of a branch that commands a topic."""
        return self.branches[tree.id].get(branch, {}).get(topic)

    def lifted(self, tree: Tree, node: Node, child: str, result: int) -> int:
        """Returns the results of a node in a tick in which its child had one of these."""
        results = self.context.results
        if node.type in SEQUENCES or node.type in FALLBACKS:
            goes_on, ends = (S, F) if node.type in SEQUENCES else (F, S)
            place = node.children.index(child)
            later = [results.named_of(tree, each) for each in node.children[place + 1 :]]
            return ordered([result, *later], goes_on, ends)
        decorated = of_decorator(node, result) if len(node.children) == 1 else None
        return results.named_of(tree, node.id) if decorated is None else decorated

    def report(self, tree: Tree, node: Node, topic: str, first: str, second: str) -> None:
        path = (step(self.context, tree, node), *self.own[first][topic], *self.own[second][topic])
        one, other = tree.nodes[first], tree.nodes[second]
        said = {"topic": topic, "node": node.label, "first": one.label, "second": other.label}
        self.context.report("BT0122", tree, other, "", path, **said)
