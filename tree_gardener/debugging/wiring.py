"""Makes nodes ask a debugger before and after their ticks, and when they are halted.

A node that asks has a function round its tick, in the list that its parent reads while it ticks, so that
switching takes effect at once; and an `AskingGuard` in place of its own, if more is to be asked. The nodes
above one that asks have the function too, which then only reads a flag: a step out of a node stops there.

Generated code asks by itself, only where it must: it calls `asking_before` and `asking_after` of the nodes
with questions. It was made for one `Epoch`; when this is over, it continues in the nodes' own methods.
"""

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Final, NamedTuple

from tree_gardener.conditions import Guard
from tree_gardener.debugging.agent import Agent
from tree_gardener.debugging.watches import Always, AnyOf, Test, may_be_true
from tree_gardener.node import Execute, Node
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.blackboard import Journal
    from tree_gardener.conditions import Condition
    from tree_gardener.observe import Recorder
    from tree_gardener.tree import Tree

RESULTS: Final = frozenset((SUCCESS, FAILURE, RUNNING, SKIPPED))
_NO_RESULTS: Final[frozenset[Status]] = frozenset()
_ALWAYS: Final = Always()
"""Where no condition is to be tested."""
DECIDES: Final = {FAILURE: "_failureIf", SUCCESS: "_successIf", SKIPPED: "_skipIf"}
"""The pre-condition that decides each result, beside ``_while``."""


class Wanted(NamedTuple):
    """The questions that a debugger wants of a node.

    Attributes:
        before: whether before its ticks.
        results: the results after which.
        within: whether between its pre-conditions and its tick, and when it is halted.
        halted: whether when it is halted.
        tests: conditions of which one must be true, or raise, for the questions before and after its tick;
            without any they are always asked.
    """

    before: bool = False
    results: frozenset[Status] = _NO_RESULTS
    within: bool = False
    halted: bool = False
    tests: tuple[Test, ...] = ()

    @property
    def is_round_tick(self) -> bool:
        """Whether it has questions before or after a tick."""
        return self.before or bool(self.results)

    @property
    def test(self) -> Test | None:
        """The condition for the questions before and after a tick; None if they are always asked."""
        tests = self.tests
        return tests[0] if len(tests) == 1 else AnyOf(tests) if tests else None

    def joined(self, other: "Wanted") -> "Wanted":
        """Returns what either of two wants."""
        rounds = [each.tests for each in (self, other) if each.is_round_tick]
        return Wanted(
            self.before or other.before,
            self.results | other.results,
            self.within or other.within,
            self.halted or other.halted,
            sum(rounds, ()) if all(rounds) else (),
        )


NOTHING: Final = Wanted()
EVERYTHING: Final = Wanted(before=True, results=RESULTS, within=True)


class Epoch:
    """The time during which the same nodes ask.

    Attributes:
        is_over: whether others ask by now.
    """

    __slots__ = ("is_over",)

    def __init__(self) -> None:
        self.is_over = False


class Asking:
    """The flags that the function round a node's tick reads, and a condition for asking."""

    __slots__ = ("before", "results", "test")

    def __init__(self) -> None:
        self.before = False
        self.results = _NO_RESULTS
        self.test: Test = _ALWAYS


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
        self.decided = "_while" if self.last is self.while_true else DECIDES[result]
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
        asks_halts: whether any node asks when it is halted. Then the tree can be held within the tick of an
            action, which may halt the tree, and every node has the function round its tick.
        alone: the node that is ticked in place of the root, or None.
        epoch: for how long the same nodes ask.
    """

    def __init__(self, tree: "Tree", agent: Agent, recorder: "Recorder") -> None:
        self.tree = tree
        self.agent = agent
        self._recorder = recorder
        self.asks_all = self.asks_halts = False
        self.alone: Node | None = None
        self._ticked_alone: Node | None = None
        self._is_removed = False
        self._wanted: Mapping[int, Wanted] = {}
        self._above: set[int] = set()
        self._asking = [Asking() for _ in tree.nodes]
        self._inner: list[Execute] = [node.execute for node in tree.nodes]
        self.epoch = Epoch()

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

    def watch_writes(self, watch: "Journal | None") -> None:
        """Calls a function with each write to the blackboard from now on; None ends it."""
        self._recorder.watch_writes(watch)

    def remove(self) -> None:
        """Ends all asking; the nodes have their own guards again."""
        self._is_removed = True
        self.watch_writes(None)
        self._wanted, self.asks_all, self.alone = {}, False, None
        if self._ticked_alone is not None and not self.tree.is_ticking:
            self._switch_root(None)
        self._apply()

    def reaches(self, node: Node) -> bool:
        """Returns whether a node, or one below it, asks."""
        if self.asks_all or self.asks_halts or node.uid in self._wanted or node.uid in self._above:
            return True
        return node.parent is None and (self.alone is not None or self._ticked_alone is not None)

    def entry(self, node: Node, inner: Execute) -> Execute:
        """Returns the function that ticks a node and asks; the node's own if it does not ask."""
        self._inner[node.uid - 1] = inner
        if not self.reaches(node):
            return inner
        asked = self._asked(node, self._asking[node.uid - 1], inner)
        return self._as_root(asked) if node.parent is None else asked

    @property
    def has_questions(self) -> bool:
        """Whether any node asks."""
        return bool(self._wanted) or self.asks_all

    def wanted(self, node: Node) -> Wanted:
        """Returns what is asked at a node."""
        return EVERYTHING if self.asks_all else self._wanted.get(node.uid, NOTHING)

    def asking_before(self, node: Node) -> Callable[[], bool]:
        """Returns a function that asks before the tick of a node, and returns whether the epoch is over."""
        before, epoch = self.agent.before, self.epoch

        def ask() -> bool:
            before(node)
            return epoch.is_over

        return ask

    def asking_after(self, node: Node, status: Status, unchanged: object) -> Callable[[], object]:
        """Returns a function that asks after a result of a node.

        It returns the result to use if this is another one or the epoch is over, else `unchanged`.
        """
        after, epoch = self.agent.after, self.epoch

        def ask() -> object:
            result = after(node, status, "")
            return result if epoch.is_over or result is not status else unchanged

        return ask

    def ticked(self, node: Node) -> Status:
        """Ticks a node that has asked before its tick, and asks after it."""
        status = self._inner[node.uid - 1]()
        return self._after(node, status) if status in self._asking[node.uid - 1].results else status

    def asked(self, node: Node, status: Status, decided: str = "") -> Status:
        """Asks after a result of a node, if this is wanted now; returns the result to use.

        `decided` is the name of the pre-condition that decided it, or "".
        """
        is_asked = status in self._asking[node.uid - 1].results
        return self.agent.after(node, status, decided) if is_asked else status

    def _asked(self, node: Node, asking: Asking, inner: Execute) -> Execute:
        before, after = self.agent.before, self._after

        def execute() -> Status:
            if asking.before and asking.test.is_doubtful and may_be_true(asking.test):
                before(node)
            status = inner()
            if status in asking.results and asking.test.is_doubtful and may_be_true(asking.test):
                return after(node, status)
            return status

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

    def _apply(self) -> None:
        """Brings guards, flags and functions of all nodes to what is chosen."""
        nodes = self.tree.nodes
        self.epoch.is_over = True
        self.epoch = Epoch()
        self.asks_halts = any(wanted.halted for wanted in self._wanted.values())
        self._above = set()
        for uid in self._wanted:
            above = nodes[uid - 1].parent
            while above is not None and above.uid not in self._above:
                self._above.add(above.uid)
                above = above.parent
        for node, asking in zip(nodes, self._asking, strict=True):
            wanted = EVERYTHING if self.asks_all else self._wanted.get(node.uid, NOTHING)
            asking.before, asking.results = wanted.before, wanted.results
            asking.test = wanted.test or _ALWAYS
            own = node.guard.inner if isinstance(node.guard, AskingGuard) else node.guard
            if not (wanted.within or wanted.halted or (wanted.results and own is not None)):
                node.guard = own
            elif own is node.guard:
                node.guard = AskingGuard(own, self.agent)
        self.tree.rewire()
