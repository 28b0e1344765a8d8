"""Decides when and for which nodes of a tree code is generated.

Code is made between ticks, a little in each, after the tree has ticked a few times in the same way. Whatever
changes how nodes are ticked (hooks, observers, marks) removes the code of the nodes concerned immediately;
they run by their own methods until they have code again. Both ways do the same, so it is never visible when
this happens.
"""

import os
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.generated.code import code_of, source_of
from tree_gardener.generated.parts import COMPOSITES, PARALLEL, UNCHANGED, Planner, Region, Variant, rule_of
from tree_gardener.generated.recovery import UNTICKED, Recovery
from tree_gardener.hooks import Hooks
from tree_gardener.leaves.behaviour import PY_FAILURE, PY_RUNNING, PY_SUCCESS
from tree_gardener.node import Control, Node
from tree_gardener.observe import Recorder
from tree_gardener.status import FAILURE, IDLE, RUNNING, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

SWITCH: Final = "TREE_GARDENER_GENERATED"
ENABLED = os.environ.get(SWITCH, "1") != "0"
"""Whether trees that are built from now on generate code; ``TREE_GARDENER_GENERATED=0`` switches it off."""
WARM_TICKS = 5
"""The ticks after which code is generated; trees that are ticked less often do not pay for it."""
BUDGET_S = 0.001
"""The time between two ticks after which no further region is begun."""

_STATUSES: Final = {
    "IDLE": IDLE,
    "RUNNING": RUNNING,
    "SUCCESS": SUCCESS,
    "FAILURE": FAILURE,
    "PY_SUCCESS": PY_SUCCESS,
    "PY_FAILURE": PY_FAILURE,
    "PY_RUNNING": PY_RUNNING,
    "RAISED": (Exception, SystemExit),
    "UNTICKED": UNTICKED,
    "UNCHANGED": UNCHANGED,
    "CLOCK": time.perf_counter,
}


class Generation:
    """The generated code of one tree.

    Attributes:
        enabled: whether code is generated.
        queue: the nodes that wait for it; nodes below them wait too.
        warm_tick: the number of the tick before which nothing is generated.
        is_doubtful: whether the statuses may be unlike those between ticks.
    """

    def __init__(self, tree: "Tree", hooks: Hooks, recorder: Recorder) -> None:
        self.tree = tree
        self.hooks = hooks
        self.recorder = recorder
        self.enabled = ENABLED
        self.queue: list[Node] = []
        self.warm_tick = 0
        self.is_doubtful = False

    def restart(self) -> None:
        """Generates everything again; the nodes have dropped their code (`Node.link`)."""
        self.queue = [self.tree.nodes[0]] if self.is_wanted() else []
        self.warm_tick = self.tree.tick_number + WARM_TICKS

    def drop(self, node: Node) -> None:
        """Removes the code in which a node is inlined; it is generated again before one of the next ticks."""
        stale: list[Node] = [node]
        while stale[-1].parent is not None:
            stale.append(stale[-1].parent)
        for each in stale:
            if isinstance(each, Control):
                each.quick = None
        if self.is_wanted():
            self.queue += stale
            if len(self.queue) > len(self.tree.nodes) + len(stale):
                self.queue = [stale[-1]]  # hooks came and went many times without a tick

    def doubt(self) -> None:
        """Removes all code until the statuses are again as they are between ticks.

        Generated code relies on it that the children of a node that is not RUNNING are IDLE. A node that
        halts or ticks the tree within its own tick can break this until the nodes above it start again.
        """
        for node in self.tree.nodes:
            if isinstance(node, Control):
                node.quick = None
        self.queue = [self.tree.nodes[0]] if self.is_wanted() else []
        self.is_doubtful = True

    def is_wanted(self) -> bool:
        """Returns whether code can do all that runs round the nodes now."""
        hooks = self.hooks
        if not self.enabled or self.tree.node_times_s is not None:
            return False
        if hooks.log is not None or hooks.profile is not None:
            return False
        if hooks.wiring is not None and hooks.wiring.asks_all:
            return False
        return all(hook.uid is not None for hook in hooks.hooks)

    def work(self) -> None:
        """Generates code for nodes in the queue, until the time for this is over."""
        if self.tree.tick_number <= self.warm_tick:
            return
        if self.is_doubtful and not self.is_consistent():
            return
        self.is_doubtful = False
        end_s = time.perf_counter() + BUDGET_S
        planner = self.planner()
        while self.queue:
            self.make(planner, self.queue.pop())
            if time.perf_counter() > end_s:
                return

    def is_consistent(self) -> bool:
        """Returns whether, where code relies on it, the children of nodes that are not RUNNING are IDLE."""
        for node in self.tree.nodes:
            rule = rule_of(node)
            if rule is None or rule.kind not in COMPOSITES or node.status is RUNNING:
                continue
            if rule.kind is not PARALLEL and any(child.status is not IDLE for child in node.children):
                return False
        return True

    def finish(self) -> None:
        """Generates all code that is still to be generated."""
        self.is_doubtful = self.is_doubtful and not self.is_consistent()
        planner = self.planner()
        while self.queue and not self.is_doubtful:
            self.make(planner, self.queue.pop())

    def planner(self) -> Planner:
        """Returns a planner for the tree as it is now."""
        recorder, hooks = self.recorder, self.hooks
        wiring = hooks.wiring
        variant = Variant(
            is_observed=bool(recorder.observers),
            marks=hooks.marks_leaves,
            times=hooks.times_leaves,
            counts=hooks.counts is not None,
            asks=wiring is not None and wiring.has_questions,
            asks_halts=wiring is not None and wiring.asks_halts,
        )
        return Planner(variant, hooks.counts, hooks.has_hook, wiring)

    def make(self, planner: Planner, node: Node) -> None:
        """Generates the code of one node, and puts the nodes that it calls into the queue."""
        if isinstance(node, Control) and node.quick is not None:
            return
        regions = planner.regions(node)
        self.queue += [called for called in planner.called if called.children]
        if not regions or not isinstance(node, Control):
            return
        functions = [self.function(planner.variant, region) for region in regions]
        if None in functions:
            return
        is_sliced = regions[0].root.is_slice
        node.quick = _in_slices(node, functions, planner.called) if is_sliced else functions[0]

    def function(self, variant: Variant, region: Region) -> Callable[[], Any] | None:
        """Returns the function of a region."""
        code = code_of(region, variant)
        if code is None:
            return None
        recorder = self.recorder
        wiring = self.hooks.wiring
        recovery = Recovery(self.tree, region, variant, self.hooks.counts, recorder, code.lines, wiring)
        fixed = {
            **_STATUSES,
            "REST": recovery.rest,
            "RECOVER": recovery.recover,
            "FLUSH": recovery.flush,
            "TOUCHED": recorder.touched.append,
            "RESULTS": recorder.results.append,
            "CURRENT": self.tree.current,
            "TREE": self.tree,
            "EPOCH": None if wiring is None else wiring.epoch,
        }
        return code.bind(region.values, fixed)

    def source(self) -> str:
        """Returns the source of all functions that nodes have now, for inspection."""
        planner = self.planner()
        found = []
        for node in self.tree.nodes:
            if isinstance(node, Control) and node.quick is not None:
                for region in planner.regions(node):
                    last = region.base + len(region.root.children)
                    which = f", children {region.base + 1} to {last}" if region.root.is_slice else ""
                    found.append(f"# node {node.uid}{which}\n{source_of(region, planner.variant)}")
        return "\n\n".join(found)


def _in_slices(node: Any, functions: list[Any], outside: list[Node]) -> Callable[[], Status | None]:
    """Returns the function of a node whose children are ticked by several functions.

    `outside` are the nodes below it that these functions call.
    """
    called = tuple([child for child in outside if child.parent is node])
    slices = tuple(functions)

    def tick() -> Status | None:
        node.begin()
        for ticked in slices:
            status: Status | None = ticked()
            if status is not None:
                return status
        ended: Status | None = node.end(called)
        return ended

    return tick
