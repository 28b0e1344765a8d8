"""Regions: a composite, and the nodes below it whose rules are written into its function.

A region is described twice. Its *shape* is a tree of `Part`s and contains nothing of the document: rules,
positions, and which values each node brings. Its *values* are a list; the shape refers to them by position.
Regions of the same shape share their code.
"""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from tree_gardener.controls.fallback import Fallback
from tree_gardener.controls.parallel import ParallelAll
from tree_gardener.controls.reactive import ReactiveFallback, ReactiveSequence
from tree_gardener.controls.sequence import Sequence
from tree_gardener.debugging.wiring import NOTHING, Wanted
from tree_gardener.decorators.result import ForceFailure, ForceSuccess, Inverter
from tree_gardener.decorators.subtree import SubTree
from tree_gardener.hooks import ResultCount
from tree_gardener.leaves.behaviour import BehaviourLeaf, ConditionLeaf, ImmediateLeaf, StatefulLeaf
from tree_gardener.leaves.constant import AlwaysFailure, AlwaysSuccess
from tree_gardener.leaves.scripts import Script, ScriptCondition
from tree_gardener.node import Control, Flash, Mark, Node
from tree_gardener.status import FAILURE, RUNNING, SUCCESS

if TYPE_CHECKING:
    from tree_gardener.debugging.wiring import Wiring

MAX_NODES: Final = 33
"""The most nodes below the root of one function, which is made in 2 ms. A composite with more has several."""
MAX_DEPTH: Final = 6
"""The most composites inside one another in one function."""

ORDERED, REACTIVE, PARALLEL, WRAPPER, SUBTREE = "ordered", "reactive", "parallel", "wrapper", "subtree"
STATEFUL, IMMEDIATE, TEST, RUN, CONSTANT = "stateful", "immediate", "test", "run", "constant"
CALL, BUNDLE = "call", "bundle"
COMPOSITES: Final = frozenset((ORDERED, REACTIVE, PARALLEL, WRAPPER, SUBTREE))

# The values that a part can bring; `Part.has` lists them in the order of their positions.
NODE, UPDATE, BEHAVIOUR, INITIALISE, TERMINATE = "n", "u", "b", "i", "t"
UID, COUNT, FINISH, SLICE, END = "d", "k", "z", "o", "e"
IF_BEFORE, ASK_BEFORE = "g", "a"
IF_SUCCESS, AFTER_SUCCESS, IF_FAILURE, AFTER_FAILURE = "h", "x", "j", "y"
DECIDING: Final = ("0", "1", "2")
WHILE, ON_SUCCESS, ON_FAILURE, POST = "w", "s", "f", "p"
_CONDITIONS: Final = frozenset((*DECIDING, WHILE, ON_SUCCESS, ON_FAILURE, POST))


UNCHANGED: Final = object()
"""Stands for the result of a node that a debugger left as it was."""


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
_STATUS: Final = {S: SUCCESS, F: FAILURE}
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
    """The extras round the ticks of nodes, for which code is made.

    Attributes:
        is_observed: whether nodes are observed.
        marks: whether leaves are marked.
        times: whether leaves are timed.
        counts: whether results are counted.
        asks: whether nodes ask a debugger.
        asks_halts: whether it is asked at halts, so that the tree can be held within the tick of a leaf.
    """

    is_observed: bool
    marks: bool
    times: bool
    counts: bool
    asks: bool = False
    asks_halts: bool = False

    def can_hold(self, kind: str) -> bool:
        """Returns whether the tree can be held within the tick of a leaf of this kind."""
        return self.asks_halts and kind in (STATEFUL, IMMEDIATE)


class Part(NamedTuple):
    """One node of a region, without anything of the document.

    Attributes:
        kind: of its rule; CALL for a child that is ticked by a call, BUNDLE for the marks of the children
            before it, which are reported together.
        results: of its rule.
        first: the position of its first value, its node.
        has: the values that it brings, a letter for each.
        position: its position among its parent's children, or in the slice of them.
        is_bundled: whether its mark is in the next bundle, if its parent continues after it. That of a
            composite has the marks of its children, too.
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
        self,
        variant: Variant,
        counts: list[ResultCount] | None,
        has_hook: Callable[[Node], bool],
        wiring: "Wiring | None" = None,
    ) -> None:
        self.variant = variant
        self.counts = counts
        self.has_hook = has_hook
        self.wiring = wiring if variant.asks else None
        self.called: list[Node] = []
        self.values: list[Any] = []
        self.classes: list[type] = []
        self.flashes: list[Flash] = []

    def is_hooked(self, node: Node) -> bool:
        """Returns whether more runs round a node than code can do: hooks, or a forced result."""
        return self.has_hook(node) or self.wanted(node).within

    def wanted(self, node: Node) -> Wanted:
        """Returns the questions that a node asks a debugger."""
        return NOTHING if self.wiring is None else self.wiring.wanted(node)

    def is_held_in(self, node: Node, rule: Rule, goes: str) -> bool:
        """Returns whether the tree may be held within the code, at a node with a result.

        All that waits must be reported before. Where a condition must be true, the code is left first.
        """
        if self.variant.can_hold(rule.kind):
            return True
        wanted = self.wanted(node)
        return wanted.test is None and (wanted.before or _STATUS[goes] in wanted.results)

    def regions(self, node: Node) -> list[Region]:
        """Returns the regions of a node: one, one for each slice of its children, or none without a rule."""
        self.called = list(node.children)
        rule = rule_of(node)
        if rule is None or rule.kind not in COMPOSITES:
            return []
        self.called = []
        slices = self.slices(node, rule)
        is_sliced = len(slices) > 1 or rule.kind is PARALLEL
        found = [self.region(node, rule, start, width, is_slice=is_sliced) for start, width in slices]
        is_useful = any(part.kind is not CALL for region in found for part in region.root.children)
        return found if is_useful else []

    def slices(self, node: Node, rule: Rule) -> list[tuple[int, int]]:
        """Divides the children of a node among functions; returns the first and the number for each.

        A child and all that is inlined below it are in one function. Fewer and larger functions are quicker.
        """
        found: list[tuple[int, int]] = []
        start = used = 0
        for index, child in enumerate(node.children):
            size = 1 if rule.kind is PARALLEL else self.size(child, 1)
            size = size if size <= MAX_NODES else 1  # it is called
            if used + size > MAX_NODES:
                found.append((start, index - start))
                start, used = index, 0
            used += size
        return [*found, (start, len(node.children) - start)]

    def size(self, node: Node, depth: int) -> int:
        """Returns the number of nodes that are inlined with a node; a number beyond MAX_NODES if too many."""
        rule = None if self.is_hooked(node) else rule_of(node)
        if rule is None or rule.kind not in COMPOSITES or rule.kind is PARALLEL or depth >= MAX_DEPTH:
            return 1
        total = 1
        for child in node.children:
            total += self.size(child, depth + 1)
            if total > MAX_NODES:
                break
        return total

    def region(self, node: Node, rule: Rule, base: int, width: int, *, is_slice: bool) -> Region:
        """Plans a node and its children from `base` on, `width` of them."""
        self.values, self.classes, self.flashes = [node], [], []
        has = NODE
        if is_slice:
            has += SLICE
            self.values.append(slice(base, base + width))
        if is_slice or rule.kind is REACTIVE:
            assert isinstance(node, Control)
            has += FINISH
            self.values.append(node.finish)
        if self.variant.is_observed and not is_slice and rule.results[0] != rule.results[1]:
            has += END
            self.values.append(None)
        children = self.children(rule, node.children[base : base + width], 1)
        if END in has:
            self.flashes.append((node.uid, _STATUS[rule.results[0]]))
            self.values[has.index(END)] = self.report()
        children += tuple(self.bundle())
        root = Part(rule.kind, rule.results, 0, has, 0, is_slice=is_slice, children=children)
        return Region(root, self.values, node, base, tuple(self.classes))

    def children(self, rule: Rule, nodes: tuple[Node, ...], depth: int) -> tuple[Part, ...]:
        """Plans children, with bundles of their marks before what is not in one; the last ones wait."""
        found: list[Part] = []
        goes = S if rule.kind in (WRAPPER, SUBTREE) else rule.results[0]
        bundles = self.variant.is_observed and rule.kind is not PARALLEL
        for position, node in enumerate(nodes):
            own = self.inlined(node, depth, in_parallel=rule.kind is PARALLEL)
            is_bundled = bundles and own is not None and _is_bundled(node, own, goes)
            is_bundled = is_bundled and own is not None and not self.is_held_in(node, own, goes)
            if not is_bundled:
                found += self.bundle()
            part = self.child(node, own, position, depth)
            if is_bundled:
                self.flashes.append((node.uid, _STATUS[goes]))
                part = part._replace(is_bundled=True)
            elif self.flashes:
                part = part._replace(children=(*part.children, *self.bundle()))
            found.append(part)
        return tuple(found)

    def bundle(self) -> list[Part]:
        """Returns the part that reports the results that wait, or nothing if there are none."""
        if not self.flashes:
            return []
        self.values.append(self.report())
        return [Part(BUNDLE, ("", ""), len(self.values) - 1, NODE, -1)]

    def report(self) -> Mark:
        """Returns the report of the results that wait. All nodes of a region are IDLE when its root is."""
        mark = (self.values[0], tuple(self.flashes))
        self.flashes.clear()
        return mark

    def child(self, node: Node, rule: Rule | None, position: int, depth: int) -> Part:
        """Plans a node below the root: generated from its rule, or called if it has none."""
        first = len(self.values)
        self.values.append(node)
        if rule is None:
            self.called.append(node)
            return Part(CALL, ("", ""), first, NODE, position)
        has = NODE + self.own(node, rule) + self.conditions(node) + self.questions(node)
        if self.counts is not None:
            has += COUNT
            self.values.append(self.counts[node.uid - 1])
        if self.variant.marks and rule.kind not in COMPOSITES:
            has += UID
            self.values.append(node.uid)
        children: tuple[Part, ...] = ()
        if rule.kind in COMPOSITES:
            children = self.children(rule, node.children, depth + 1)
        return Part(rule.kind, rule.results, first, has, position, children=children)

    def inlined(self, node: Node, depth: int, *, in_parallel: bool) -> Rule | None:
        """Returns the rule of a node if it can be written into the function, else None."""
        rule = None if self.is_hooked(node) else rule_of(node)
        if rule is None:
            return None
        if in_parallel:
            wanted = self.wanted(node)
            asks = wanted.before or RUNNING in wanted.results or self.variant.can_hold(rule.kind)
            is_plain = rule.kind is STATEFUL and node.guard is None and not asks
        elif rule.kind in COMPOSITES:
            fits = depth < MAX_DEPTH and self.size(node, depth) <= MAX_NODES
            is_plain = rule.kind is not PARALLEL and fits
        else:
            is_plain = not isinstance(node, (Script, ScriptCondition)) or node.script.fixed is not None
        return rule if is_plain else None

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

    def questions(self, node: Node) -> str:
        """Adds what asks a debugger round a node's tick, or the conditions for it; returns the letters."""
        wiring, wanted = self.wiring, self.wanted(node)
        if wiring is None or not wanted.is_round_tick:
            return ""
        test = wanted.test
        found: list[tuple[str, object]] = []
        if wanted.before:
            found.append((ASK_BEFORE, wiring.asking_before(node)) if test is None else (IF_BEFORE, test))
        for tested, letter, status in (
            (IF_SUCCESS, AFTER_SUCCESS, SUCCESS),
            (IF_FAILURE, AFTER_FAILURE, FAILURE),
        ):
            if status in wanted.results:
                ask = wiring.asking_after(node, status, UNCHANGED)
                found.append((letter, ask) if test is None else (tested, test))
        self.values += [value for _, value in found]
        return "".join(letter for letter, _ in found)


def _is_bundled(node: Node, rule: Rule, goes: str) -> bool:
    """Returns whether a result `goes` of a node can be reported later, together with those of its siblings.

    A composite must have this result only if no child left the usual way, which reports what waits.
    """
    guard = node.guard
    if rule.kind in COMPOSITES:
        return guard is None and rule.results[0] == goes != rule.results[1]
    if rule.kind in (RUN, CONSTANT) and rule.results[0] != goes:
        return False
    return guard is None or (guard.on_success is None and guard.on_failure is None and guard.post is None)
