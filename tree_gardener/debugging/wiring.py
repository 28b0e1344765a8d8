"""Makes nodes ask a debugger before and after their ticks, and when they are halted.

A node that asks has a function round its tick, in the list that its parent reads while it ticks, so that
switching takes effect at once; and an `AskingGuard` in place of its own, if more is to be asked. The nodes
above one that asks have the function too, which then only reads a flag: a step out of a node stops there.
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final, NamedTuple

from tree_gardener.conditions import Guard
from tree_gardener.debugging.agent import Agent
from tree_gardener.node import Execute, Node
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.conditions import Condition
    from tree_gardener.tree import Tree

RESULTS: Final = frozenset((SUCCESS, FAILURE, RUNNING, SKIPPED))
_NO_RESULTS: Final[frozenset[Status]] = frozenset()
_DECIDING: Final = {FAILURE: "_failureIf", SUCCESS: "_successIf", SKIPPED: "_skipIf"}


class Wanted(NamedTuple):
    """The questions that a debugger wants of a node.

    Attributes:
        before: whether before its ticks.
        results: the results after which.
        within: whether between its pre-conditions and its tick, and when it is halted.
    """

    before: bool = False
    results: frozenset[Status] = _NO_RESULTS
    within: bool = False

    def joined(self, other: "Wanted") -> "Wanted":
        """Returns what either of two wants."""
        return Wanted(self.before or other.before, self.results | other.results, self.within or other.within)


NOTHING: Final = Wanted()
EVERYTHING: Final = Wanted(before=True, results=RESULTS, within=True)


class Asking:
    """The flags that the function round a node's tick reads."""

    __slots__ = ("before", "results")

    def __init__(self) -> None:
        self.before = False
        self.results = _NO_RESULTS


class AskingGuard(Guard):
    """The conditions of a node, with the debugger between them and the tick, and told of halts.

    Attributes:
        inner: the node's own guard, or None.
        decided: the name of the pre-condition that decided the last result, or "".
    """

    __slots__ = ("agent", "decided", "inner", "last")

    def __init__(self, inner: Guard | None, agent: Agent) -> None:
        self.inner = inner
        self.agent = agent
        self.decided = ""
        self.last: Condition | None = None
        self.deciding = inner.deciding if inner is not None else []
        self.while_true = inner.while_true if inner is not None else None
        self.on_success = inner.on_success if inner is not None else None
        self.on_failure = inner.on_failure if inner is not None else None
        self.post = inner.post if inner is not None else None
        self.on_halted = inner.on_halted if inner is not None else None

    def before(self, node: Node) -> Status | None:
        """Tests the pre-conditions, and then asks for a forced result."""
        self.decided = ""
        result = super().before(node)
        if result is None:
            return self.agent.forced(node)
        self.decided = "_while" if self.last is self.while_true else _DECIDING[result]
        return result

    def run(self, node: Node, condition: "Condition") -> object:
        """Runs a condition and remembers which one it was."""
        self.last = condition
        return super().run(node, condition)

    def stop(self, node: Node) -> None:
        """Halts the node, unless the debugger says that it has not begun, and tells the debugger."""
        was_running = node.status is RUNNING
        if not self.agent.may_halt(node):
            node.status = IDLE
            return
        super().stop(node)
        if was_running:
            self.agent.halted(node)


class Wiring:
    """The nodes of a tree that ask its debugger.

    Attributes:
        tree: the tree.
        asks_all: whether every node asks.
        alone: the node that is ticked in place of the root, or None.
    """

    def __init__(self, tree: "Tree", agent: Agent) -> None:
        self.tree = tree
        self.agent = agent
        self.asks_all = False
        self.alone: Node | None = None
        self._ticked_alone: Node | None = None
        self._is_removed = False
        self._wanted: Mapping[int, Wanted] = {}
        self._above: set[int] = set()
        self._asking = [Asking() for _ in tree.nodes]

    def choose(self, wanted: Mapping[int, Wanted], *, everything: bool = False) -> None:
        """Chooses the nodes that ask from now on, by uid; with `everything`, all nodes ask."""
        if everything == self.asks_all and (everything or wanted == self._wanted):
            self._wanted = dict(wanted)
            return
        self._wanted, self.asks_all = dict(wanted), everything
        self._apply()

    def tick_alone(self, node: Node | None) -> None:
        """Ticks a node in place of the root from the next tick on, with all others halted; None ends it."""
        self.alone = None if node is self.tree.nodes[0] else node
        self._apply()

    def remove(self) -> None:
        """Ends all asking; the nodes have their own guards again."""
        self._is_removed = True
        self._wanted, self.asks_all, self.alone = {}, False, None
        if self._ticked_alone is not None and not self.tree.is_ticking:
            self._switch_root(None)
        self._apply()

    def reaches(self, node: Node) -> bool:
        """Returns whether a node, or one below it, asks."""
        if self.asks_all or node.uid in self._wanted or node.uid in self._above:
            return True
        return node.parent is None and (self.alone is not None or self._ticked_alone is not None)

    def entry(self, node: Node, inner: Execute) -> Execute:
        """Returns the function that ticks a node and asks; the node's own if it does not ask."""
        if not self.reaches(node):
            return inner
        asked = self._asked(node, self._asking[node.uid - 1], inner)
        return self._as_root(asked) if node.parent is None else asked

    # -- within a tick ----------------------------------------------------------------------------------

    def _asked(self, node: Node, asking: Asking, inner: Execute) -> Execute:
        before, after = self.agent.before, self._after

        def execute() -> Status:
            if asking.before:
                before(node)
            status = inner()
            return after(node, status) if status in asking.results else status

        return execute

    def _after(self, node: Node, status: Status) -> Status:
        guard = node.guard
        decided = ""
        if isinstance(guard, AskingGuard):
            decided, guard.decided = guard.decided, ""
        return self.agent.after(node, status, decided)

    def _as_root(self, inner: Execute) -> Execute:
        def execute() -> Status:
            if self.alone is not self._ticked_alone:
                self._switch_root(self.alone)
            return inner() if self.alone is None else self._execute_alone(self.alone)

        return execute

    def _switch_root(self, node: Node | None) -> None:
        """Halts everything before another node is ticked as the root."""
        self._ticked_alone = node
        for each in self.tree.nodes:
            if each.status is RUNNING:
                each.stop()
        for each in self.tree.nodes:
            self._make_idle(each)

    def _execute_alone(self, node: Node) -> Status:
        assert node.parent is not None
        try:
            status = node.parent.ticks[node.parent.children.index(node)]()
        finally:
            if self._is_removed:
                self._switch_root(None)
        if status is SUCCESS or status is FAILURE:
            self._make_idle(node)
        return status

    def _make_idle(self, node: Node) -> None:
        node.status = IDLE
        if node.journal is not None and node.reported is not IDLE:
            node.journal.touched.append(node)

    # -- switching --------------------------------------------------------------------------------------

    def _apply(self) -> None:
        """Brings guards, flags and functions of all nodes to what is chosen."""
        nodes = self.tree.nodes
        self._above = set()
        for uid in self._wanted:
            above = nodes[uid - 1].parent
            while above is not None and above.uid not in self._above:
                self._above.add(above.uid)
                above = above.parent
        for node, asking in zip(nodes, self._asking, strict=True):
            wanted = EVERYTHING if self.asks_all else self._wanted.get(node.uid, NOTHING)
            asking.before, asking.results = wanted.before, wanted.results
            own = node.guard.inner if isinstance(node.guard, AskingGuard) else node.guard
            if not (wanted.within or (wanted.results and own is not None)):
                node.guard = own
            elif own is node.guard:
                node.guard = AskingGuard(own, self.agent)
        self.tree.rewire()
