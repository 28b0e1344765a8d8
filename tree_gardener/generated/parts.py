"""Regions: a composite, and the nodes below it whose rules are written into its function.

A region is described twice. Its *shape* is a tree of `Part`s and contains nothing of the document: rules,
positions, and which values each node brings. Its *values* are a list; the shape refers to them by position.
Regions of the same shape share their code.
"""

from collections.abc import Callable, Mapping
from typing import Any, Final, NamedTuple

from tree_gardener.controls.fallback import Fallback
from tree_gardener.controls.parallel import ParallelAll
from tree_gardener.controls.reactive import ReactiveFallback, ReactiveSequence
from tree_gardener.controls.sequence import Sequence
from tree_gardener.decorators.result import ForceFailure, ForceSuccess, Inverter
from tree_gardener.decorators.subtree import SubTree
from tree_gardener.hooks import ResultCount
from tree_gardener.leaves.behaviour import BehaviourLeaf, ConditionLeaf, ImmediateLeaf, StatefulLeaf
from tree_gardener.leaves.constant import AlwaysFailure, AlwaysSuccess
from tree_gardener.leaves.scripts import Script, ScriptCondition
from tree_gardener.node import Control, Node
from tree_gardener.status import FAILURE, RUNNING, SUCCESS, Status

MAX_NODES: Final = 32
"""The most nodes in one function. A composite with more children has several functions."""
MAX_DEPTH: Final = 6
"""The most composites inside one another in one function."""

ORDERED, REACTIVE, PARALLEL, WRAPPER, SUBTREE = "ordered", "reactive", "parallel", "wrapper", "subtree"
STATEFUL, IMMEDIATE, TEST, RUN, CONSTANT = "stateful", "immediate", "test", "run", "constant"
CALL, BUNDLE = "call", "bundle"
COMPOSITES: Final = frozenset((ORDERED, REACTIVE, PARALLEL, WRAPPER, SUBTREE))

# The values that a part can bring; `Part.has` lists them in the order of their positions.
NODE, UPDATE, BEHAVIOUR, INITIALISE, TERMINATE = "n", "u", "b", "i", "t"
MARK_SUCCESS, MARK_FAILURE, UID, COUNT, FINISH, SLICE = "S", "F", "d", "k", "z", "o"
DECIDING: Final = ("0", "1", "2")
WHILE, ON_SUCCESS, ON_FAILURE, POST = "w", "s", "f", "p"
_CONDITIONS: Final = frozenset((*DECIDING, WHILE, ON_SUCCESS, ON_FAILURE, POST))


class Rule(NamedTuple):
    """The code for a class of nodes.

    Attributes:
        kind: one of the words above.
        results: the result for a child's SUCCESS and for its FAILURE, or what a leaf of constant result
            returns; for an ordered or reactive node, the result that continues and the one that ends.
        execute: the method that the code stands for; a class whose method was replaced is left alone.
        go_on: the method of composites that continues after a child; likewise.
    """

    kind: str
    results: tuple[str, str]
    execute: Callable[..., Any]
    go_on: Callable[..., Any] | None


S, F = "SUCCESS", "FAILURE"
RULES: Final[Mapping[type, Rule]] = {
    cls: Rule(kind, results, cls.execute, getattr(cls, "go_on", None))
    for cls, kind, results in (
        (Sequence, ORDERED, (S, F)),
        (Fallback, ORDERED, (F, S)),
        (ReactiveSequence, REACTIVE, (S, F)),
        (ReactiveFallback, REACTIVE, (F, S)),
        (ParallelAll, PARALLEL, ("", "")),
        (Inverter, WRAPPER, (F, S)),
        (ForceSuccess, WRAPPER, (S, S)),
        (ForceFailure, WRAPPER, (F, F)),
        (SubTree, SUBTREE, (S, F)),
        (StatefulLeaf, STATEFUL, ("", "")),
        (ImmediateLeaf, IMMEDIATE, ("", "")),
        (ConditionLeaf, IMMEDIATE, ("", "")),
        (ScriptCondition, TEST, ("", "")),
        (Script, RUN, (S, S)),
        (AlwaysSuccess, CONSTANT, (S, S)),
        (AlwaysFailure, CONSTANT, (F, F)),
    )
}


class Variant(NamedTuple):
    """Whether nodes are observed, and whether leaves are marked, timed or counted."""

    is_observed: bool
    marks: bool
    times: bool
    counts: bool


class Part(NamedTuple):
    """One node of a region, without anything of the document.

    Attributes:
        kind: of its rule; CALL for a child that is ticked by a call, BUNDLE for the marks of the children
            before it, which are reported together.
        results: of its rule.
        first: the position of its first value, its node.
        has: the values that it brings, a letter for each.
        position: its position among its parent's children, or in the slice of them.
        is_bundled: whether its mark is in the next bundle, if its parent continues after it.
        is_slice: whether the function ticks a slice of the root's children, without its start and end.
        children: its children.
    """

    kind: str
    results: tuple[str, str]
    first: int
    has: str
    position: int
    is_bundled: bool = False
    is_slice: bool = False
    children: tuple["Part", ...] = ()

    @property
    def is_guarded(self) -> bool:
        """Whether it has pre- or post-conditions."""
        return not _CONDITIONS.isdisjoint(self.has)

    def place(self, letter: str) -> int:
        """Returns the position of one of its values."""
        return self.first + self.has.index(letter)


class Region(NamedTuple):
    """A function to be made.

    Attributes:
        root: the shape.
        values: the values for it, in order; that of a part's node comes first.
        node: the root's node.
        base: the position of the first child, in a slice.
        classes: the classes of the behaviours. Code that is specialised by Python for one class is not shared
            with others.
    """

    root: Part
    values: list[Any]
    node: Node
    base: int
    classes: tuple[type, ...]


def rule_of(node: Node) -> Rule | None:
    """Returns the rule of a node's class; None if there is none, or its method was replaced."""
    cls = type(node)
    rule = RULES.get(cls)
    if rule is None or cls.execute is not rule.execute or getattr(cls, "go_on", None) is not rule.go_on:
        return None
    return rule


class Planner:
    """Makes the regions of a tree.

    Attributes:
        called: children of the last regions that are ticked by a call, and may have regions of their own.
    """

    def __init__(
        self, variant: Variant, counts: list[ResultCount] | None, is_hooked: Callable[[Node], bool]
    ) -> None:
        self.variant = variant
        self.counts = counts
        self.is_hooked = is_hooked
        self.called: list[Node] = []
        self.values: list[Any] = []
        self.classes: list[type] = []
        self.room = 0

    def regions(self, node: Node) -> list[Region]:
        """Returns the regions of a node: one, one for each slice of its children, or none without a rule."""
        self.called = list(node.children)
        rule = rule_of(node)
        if rule is None or rule.kind not in COMPOSITES:
            return []
        is_sliced = len(node.children) > MAX_NODES or rule.kind is PARALLEL
        width = MAX_NODES if is_sliced else len(node.children)
        self.called = []
        found = [
            self.region(node, rule, start, width, is_slice=is_sliced)
            for start in range(0, len(node.children), width)
        ]
        is_useful = any(part.kind is not CALL for region in found for part in region.root.children)
        return found if is_useful else []

    def region(self, node: Node, rule: Rule, base: int, width: int, *, is_slice: bool) -> Region:
        """Plans a node and its children from `base` on, `width` of them."""
        self.values, self.classes = [node], []
        self.room = MAX_NODES - width
        has = NODE + (self.marks(node) if not is_slice else "")
        if is_slice:
            has += SLICE
            self.values.append(slice(base, base + width))
        if is_slice or rule.kind is REACTIVE:
            assert isinstance(node, Control)
            has += FINISH
            self.values.append(node.finish)
        children = self.children(rule, node.children[base : base + width], 1)
        root = Part(rule.kind, rule.results, 0, has, 0, is_slice=is_slice, children=children)
        return Region(root, self.values, node, base, tuple(self.classes))

    def children(self, rule: Rule, nodes: tuple[Node, ...], depth: int) -> tuple[Part, ...]:
        """Plans children, with the bundles of their marks."""
        found: list[Part] = []
        marks: list[tuple[int, Status]] = []
        goes = rule.results[0]
        bundles = self.variant.is_observed and rule.kind in (ORDERED, REACTIVE)
        for position, node in enumerate(nodes):
            part = self.child(node, position, depth, in_parallel=rule.kind is PARALLEL)
            if bundles and _can_be_bundled(part, goes):
                marks.append((node.uid, SUCCESS if goes == S else FAILURE))
                part = part._replace(is_bundled=True)
            elif marks:
                found.append(self.bundle(marks))
            found.append(part)
        if marks:
            found.append(self.bundle(marks))
        return tuple(found)

    def bundle(self, marks: list[tuple[int, Status]]) -> Part:
        """Plans the report of several results at once, and empties the list.

        All nodes of a region are IDLE again when its root is not RUNNING.
        """
        self.values.append((self.values[0], RUNNING, tuple(marks)))
        marks.clear()
        return Part(BUNDLE, ("", ""), len(self.values) - 1, NODE, -1)

    def child(self, node: Node, position: int, depth: int, *, in_parallel: bool) -> Part:
        """Plans a node below the root."""
        first = len(self.values)
        self.values.append(node)
        rule = None if self.is_hooked(node) else rule_of(node)
        if rule is None or not self.is_plain(node, rule, depth, in_parallel=in_parallel):
            self.called.append(node)
            return Part(CALL, ("", ""), first, NODE, position)
        has = NODE + self.own(node, rule) + self.marks(node) + self.conditions(node)
        if self.counts is not None:
            has += COUNT
            self.values.append(self.counts[node.uid - 1])
        if self.variant.marks and rule.kind not in COMPOSITES:
            has += UID
            self.values.append(node.uid)
        children: tuple[Part, ...] = ()
        if rule.kind in COMPOSITES:
            self.room -= len(node.children)
            children = self.children(rule, node.children, depth + 1)
        return Part(rule.kind, rule.results, first, has, position, children=children)

    def is_plain(self, node: Node, rule: Rule, depth: int, *, in_parallel: bool) -> bool:
        """Returns whether the rule of a node can be written into the function."""
        if in_parallel:
            return rule.kind is STATEFUL and node.guard is None
        if rule.kind in COMPOSITES:
            return rule.kind is not PARALLEL and depth < MAX_DEPTH and len(node.children) <= self.room
        return not isinstance(node, (Script, ScriptCondition)) or node.script.fixed is not None

    def own(self, node: Node, rule: Rule) -> str:
        """Adds the values of a leaf's rule; returns their letters."""
        if isinstance(node, (Script, ScriptCondition)):
            self.values.append(node.script.fixed)
            return UPDATE
        if not isinstance(node, BehaviourLeaf):
            return ""
        self.classes.append(type(node.instance_behaviour))
        self.values += [node.update, node.instance_behaviour]
        has = UPDATE + BEHAVIOUR
        for letter, method in ((INITIALISE, node.initialise), (TERMINATE, node.terminate)):
            if method is not None:
                has += letter
                self.values.append(method)
        return has

    def marks(self, node: Node) -> str:
        """Adds the marks with which an observed node reports its results; returns their letters."""
        if not self.variant.is_observed:
            return ""
        self.values += node.marks[:2]
        return MARK_SUCCESS + MARK_FAILURE

    def conditions(self, node: Node) -> str:
        """Adds the scripts of a node's conditions, which are called; returns their letters."""
        guard = node.guard
        if guard is None:
            return ""
        named = [
            *zip(DECIDING, (condition for condition, _ in guard.deciding), strict=False),
            (WHILE, guard.while_true),
            (ON_SUCCESS, guard.on_success),
            (ON_FAILURE, guard.on_failure),
            (POST, guard.post),
        ]
        self.values += [condition.call for _, condition in named if condition is not None]
        return "".join(letter for letter, condition in named if condition is not None)


def _can_be_bundled(part: Part, goes: str) -> bool:
    """Returns whether a leaf's result `goes` can be reported later, together with those of its siblings."""
    if part.kind in (RUN, CONSTANT) and part.results[0] != goes:
        return False
    is_leaf = part.kind in (STATEFUL, IMMEDIATE, TEST, RUN, CONSTANT)
    return is_leaf and not {ON_SUCCESS, ON_FAILURE, POST}.intersection(part.has)
