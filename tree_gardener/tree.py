"""A behaviour tree that runs."""

import logging
import pathlib
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager
from typing import Any, TypeVar

from tree_gardener import tree_tools, users_nodes
from tree_gardener.blackboard import Blackboard, Entry, board_at
from tree_gardener.clock import Clock, SystemClock, Timers
from tree_gardener.collector import paused_collector
from tree_gardener.debugging.agent import Agent
from tree_gardener.deep import call_deep
from tree_gardener.enums import Enums, constants, types
from tree_gardener.errors import LoadError, TickError
from tree_gardener.forest import Forest
from tree_gardener.groot import Groot2Publisher
from tree_gardener.hooks import After, Before, Hook, Hooks, ResultCount
from tree_gardener.loader import Builder
from tree_gardener.node import Execute, Node
from tree_gardener.observe import Observer, Recorder
from tree_gardener.profiling import Profile
from tree_gardener.py_trees_board import Place, Value
from tree_gardener.registry import build_registry
from tree_gardener.status import FAILURE, IDLE, RUNNING, SUCCESS, Status
from tree_gardener.substitution import parse_rules
from tree_gardener.ways import Ways

T = TypeVar("T")

_log = logging.getLogger("tree_gardener")


class Tree:
    """A tree of nodes, its blackboard, and the functions that tick it.

    Create it with `from_xml` or `from_file`; call `setup` once, then tick functions, at the end `shutdown`.

    Attributes:
        nodes: all nodes in pre-order; ``nodes[0]`` is the root node.
        blackboard: the root blackboard.
        boards: all scopes of the blackboard.
        clock: the time for Delay, Timeout and Sleep.
        numbers: the numbers in BehaviorTree.CPP of the nodes whose uid is another one.
        enums: constants for scripts and Switch, by name.
        wake_up: set by nodes that need another tick soon.
        on_error: called with the error when an action raises, which then counts as FAILURE of its node; if
            None, the error is raised out of the tick.
        fault: an error of a callback that ends the run, until the runner has seen it; else None.
        on_warning: called with a node and a sentence if a mistake is tolerated, once for each node and
            sentence; if None, the sentence goes to the logger ``tree_gardener``.
        warned: the uids and sentences of which the user was warned.
        tick_number: the number of ticks so far.
        slowest: duration and uid of the slowest action of the last tick, while leaves are timed.
        node_times_s: the time of each node in the tick, if an observer requested times; else None.
    """

    def __init__(self, clock: Clock | None, blackboard: Blackboard | None, enums: Mapping[str, int]) -> None:
        self.clock: Clock = clock or SystemClock()
        self.timers = Timers(self.clock)
        self._timer_heap = self.timers.heap
        self.blackboard = blackboard if blackboard is not None else Blackboard()
        self.enums = dict(enums)
        self.nodes: list[Node] = []
        self.boards: list[Blackboard] = [self.blackboard]
        self.numbers: dict[int, int] = {}
        self.depth = 0
        self.wake_up = False
        self.on_error: Callable[[TickError], None] | None = None
        self.fault: TickError | None = None
        self.on_warning: Callable[[Node, str], None] | None = None
        self.warned: set[tuple[int, str]] = set()
        self.tick_number = 0
        self._ended_tick = 0
        self._current: list[int] | memoryview[int] = [0]
        self.slowest: tuple[float, int] = (0.0, 0)
        self.node_times_s: dict[int, float] | None = None
        self._hooks = Hooks(self)
        self._recorder = Recorder(self)
        self._ways = Ways(self, self._hooks, self._recorder)
        self._signal = threading.Event()

    @classmethod
    @paused_collector()
    def from_xml(  # noqa: PLR0913 - most are rare
        cls,
        text: str | bytes,
        nodes: Mapping[str, Any] | None = None,
        clock: Clock | None = None,
        *,
        main_tree: str | None = None,
        base_path: str | pathlib.Path | None = None,
        name: str = "tree.xml",
        documents: Sequence[str | bytes] = (),
        blackboard: Blackboard | None = None,
        enums: Enums | None = None,
        substitutions: Mapping[str, Any] | str | None = None,
    ) -> "Tree":
        """Builds a tree from a document.

        Args:
            text: the document. A self-contained one brings the sources of its actions.
            nodes: classes of actions by XML tag; they override those in the document.
            clock: the time for Delay, Timeout and Sleep; the computer's if None.
            main_tree: the tree to run, if it is not the one that the document names.
            base_path: the folder to which ``<include>`` is relative.
            name: the name of the document in messages.
            documents: other documents, whose trees can be used as SubTrees.
            blackboard: the root blackboard; entries in it keep their types.
            enums: constants for scripts and Switch by name, and enumerations by name, which ports can have as
                their type; they are added to those in the document.
            substitutions: rules that replace nodes, as BehaviorTree.CPP's JSON.

        Raises:
            LoadError: the document is refused; `diagnostics` holds every error.
        """
        forest = Forest()
        forest.read_all(documents, text, name, base_path)
        named = {**forest.enums, **(enums or {})}
        registry = build_registry(forest.with_actions(nodes or {}), types(named))
        problems = forest.check(registry)
        if problems:
            raise LoadError(problems)
        main = forest.main_tree(main_tree)
        rules = parse_rules(substitutions or {})
        problems = [] if rules else forest.check_cycles(main)  # rules may replace SubTrees
        if problems:
            raise LoadError(problems)
        tree = cls(clock, blackboard, constants(named))
        builder = Builder(tree, forest, registry, rules)
        tree.nodes = builder.build(main)
        if builder.problems:
            raise LoadError(builder.problems)
        tree._adopt(builder)
        return tree

    @classmethod
    def from_file(
        cls,
        path: str | pathlib.Path,
        nodes: Mapping[str, Any] | None = None,
        clock: Clock | None = None,
        **more: Any,
    ) -> "Tree":
        """Builds a tree from a file, to which ``<include>`` is relative; as `from_xml` otherwise."""
        path = pathlib.Path(path)
        more.setdefault("base_path", path.parent)
        more.setdefault("name", str(path))
        return cls.from_xml(path.read_bytes(), nodes, clock, **more)

    def _adopt(self, builder: Builder) -> None:
        """Installs the nodes that a builder made."""
        self.boards = builder.boards
        self.blackboard.scopes = lambda path: board_at(self.boards, path)
        self.depth = builder.depth
        for node in self.nodes:
            node.prepare()
        self.link()
        tree_tools.use_blackboard(self.blackboard)

    @property
    def root(self) -> Any:
        """The tree as py_trees sees it: its tools, visitors and ``BehaviourTree`` work on it."""
        return self.nodes[0].behaviour

    @property
    def current_uid(self) -> int:
        """The uid of the action that is being ticked, while leaves are marked; else 0."""
        return self._current[0]

    @property
    def current(self) -> "list[int] | memoryview[int]":
        """A sequence whose first item is `current_uid`; it may be memory shared with another process."""
        return self._current

    @current.setter
    def current(self, memory: "list[int] | memoryview[int]") -> None:
        self._current = memory
        if self._hooks.marks_leaves:
            self.link()

    def use_clock(self, clock: Clock) -> None:
        """Replaces the clock before the first tick, for example by one that needs an rclpy node."""
        self.clock = self.timers.clock = clock

    def setup(self, node: Any = None, **kwargs: Any) -> None:
        """Calls ``setup(node=…)`` of each action and own control node once, in pre-order.

        Args:
            node: the rclpy node, or None.
            kwargs: passed on unchanged.

        Raises:
            TickError: a behaviour raised an exception.
        """
        users_nodes.setup(self.nodes, node, kwargs)

    def halt(self) -> None:
        """Halts the whole tree, as BT.CPP's ``haltTree``: the root, and then every node once more."""
        self._guarded_without_telling(self._halt)
        if self._recorder.observers:
            self._recorder.tell(0.0)

    def _halt(self) -> None:
        if self._ended_tick != self.tick_number:
            self._ways.generation.doubt()  # a node halts the tree within its own tick
        for node in (self.nodes[0], *self.nodes):
            node.stop()
        self.nodes[0].status = IDLE

    def shutdown(self) -> None:
        """Halts the tree and calls ``shutdown()`` of each behaviour, even if some of them raise.

        Raises:
            TickError: the first error.
        """
        first: TickError | None = None
        try:
            self.halt()
        except TickError as error:
            first = error
            users_nodes.halt_one_by_one(self.nodes)
        failed = users_nodes.shutdown(self.nodes)
        first = first or failed
        if first is not None:
            raise first

    def tick_exactly_once(self) -> Status:
        """Ticks the root once.

        Raises:
            TickError: a node could not do its work.
        """
        number, ways = self.tick_number, self._ways
        if ways.is_plain and self._ended_tick == number:
            self.tick_number = number + 1
            if self._timer_heap:
                self.timers.fire()
            tick = ways.tick_root
            try:
                status = tick()
            finally:
                self._ended_tick = self.tick_number
            if status is SUCCESS or status is FAILURE:
                self.nodes[0].status = IDLE
            return status
        return self._guarded(self._tick_exactly_once)

    def _tick_exactly_once(self) -> Status:
        self._begin()
        try:
            return self._reset_root(self._ways.tick_root())
        finally:
            self._ended_tick = self.tick_number

    def tick_once(self) -> Status:
        """Ticks the root, and again while it is RUNNING and a node has woken the tree up.

        Raises:
            TickError: a node could not do its work.
        """
        return self._guarded(self._tick_once)

    def _tick_once(self) -> Status:
        self._begin()
        try:
            status = self._ways.tick_root()
            while status is RUNNING and self._woken():
                status = self._ways.tick_root()
            return self._reset_root(status)
        finally:
            self._ended_tick = self.tick_number

    def tick_while_running(self, sleep_msec: float = 10) -> Status:
        """Ticks with `tick_once` and sleeps in between, until the root is not RUNNING.

        Args:
            sleep_msec: the sleep ends earlier when the tree is woken up.

        Raises:
            TickError: a node could not do its work.
        """
        while True:
            status = self.tick_once()
            if status is not RUNNING:
                return status
            self.sleep(sleep_msec / 1000.0)

    def sleep(self, duration_s: float) -> None:
        """Waits until the time is over or the tree is woken up; timers fire on the way."""
        end_s = self.clock.now() + duration_s
        while not self._woken():
            now_s = self.clock.now()
            if now_s >= end_s - 1e-9:
                return
            timer_s = self.timers.next_s()
            wait_s = max((end_s if timer_s is None else min(end_s, timer_s)) - now_s, 0.0)
            if isinstance(self.clock, SystemClock):
                self._signal.wait(wait_s)
            else:
                self.clock.sleep(wait_s)

    def wake(self) -> None:
        """Wakes the tree up; may be called from any thread."""
        self.wake_up = True
        self._signal.set()

    def fire_timers(self) -> None:
        """Fires the timers that are due now; otherwise they fire at the next tick."""
        self._guarded_without_telling(self.timers.fire)

    def _begin(self) -> None:
        if self._ended_tick != self.tick_number:
            self._ways.generation.doubt()  # a node ticks the tree within its own tick
        self.tick_number += 1
        self.slowest = (0.0, 0)
        if self.timers.heap:
            self.timers.fire()
        self._ways.work()

    def _woken(self) -> bool:
        """Returns whether the wake-up flag is set, and clears it."""
        if self.timers.heap:
            self.timers.fire()
        woken, self.wake_up = self.wake_up, False
        self._signal.clear()
        return woken

    def _reset_root(self, status: Status) -> Status:
        if status is SUCCESS or status is FAILURE:
            self.nodes[0].status = IDLE
        return status

    def _guarded(self, function: Callable[[], T]) -> T:
        """Calls a function that ticks or halts nodes, with stack for deep trees, and notifies observers."""
        if self._recorder.observers:
            return self._recorder.tick(lambda: self._guarded_without_telling(function))
        return self._guarded_without_telling(function)

    def _guarded_without_telling(self, function: Callable[[], T]) -> T:
        return call_deep(function, self.depth) if self.depth > self._ways.deep else function()

    def warn(self, node: Node, message: str) -> None:
        """Reports a tolerated fault of a node, once."""
        if (node.uid, message) in self.warned:
            return
        self.warned.add((node.uid, message))
        if self.on_warning is not None:
            self.on_warning(node, message)
        else:
            _log.warning("node '%s': %s", node.path, message)

    def journal_writes(self, callback: Callable[[Entry, int], None] | None) -> None:
        """Calls `callback` with each write to the blackboard, in order, while the tree is observed.

        A removed entry is not in its scope any more. None ends it.
        """
        self._recorder.writes = callback

    def outside_entries(self) -> Mapping[Place, Value]:
        """Returns what py_trees keeps beside the blackboard, while the tree is observed."""
        return self._recorder.outside.entries()

    def observe(self, callback: Observer, *, node_times: bool = False) -> Callable[[], None]:
        """Calls `callback` after each tick with the changes; returns the function that unsubscribes it.

        Args:
            callback: called with a `TickChanges`, also after a tick that raised an exception. The first one
                contains all nodes that are not IDLE, and all entries.
            node_times: whether each node is measured too.
        """
        recorder = self._recorder
        if not recorder.observers:
            recorder.attach()
        recorder.observers.append(callback)
        if node_times and self.node_times_s is None:
            self.node_times_s = {}
        self.link()

        def unsubscribe() -> None:
            if callback not in recorder.observers:
                return
            recorder.observers.remove(callback)
            if not recorder.observers:
                recorder.detach()
                self.node_times_s = None
            self.link()

        return unsubscribe

    def add_hook(
        self, *, before: Before | None = None, after: After | None = None, node: Node | int | None = None
    ) -> Callable[[], None]:
        """Calls functions before and after the ticks of one node, or of all.

        Returns the function that removes them.

        Args:
            before: called with the node; if it returns a status, the node is not ticked, and has this result.
            after: called with the node and its result; if it returns a status, this replaces the result.
            node: the node or its uid; None for all nodes.
        """
        uid = node.uid if isinstance(node, Node) else node
        return self._hooks.add(Hook(uid, before, after))

    def mark_leaves(self, *, on: bool = True) -> None:
        """Updates `current` at each leaf, so that an action that hangs can be named."""
        self._hooks.marks_leaves = on
        self._hooks.times_leaves &= on
        self.link()

    def time_leaves(self, *, on: bool = True) -> None:
        """Updates `current` and `slowest` at each leaf, so that a slow action can be named."""
        self._hooks.marks_leaves = self._hooks.times_leaves = on
        self.link()

    def count_results(self) -> list[ResultCount]:
        """Counts the results of each node from now on; returns the counts, in the order of `nodes`."""
        if self._hooks.counts is None:
            self._hooks.counts = [ResultCount() for _ in self.nodes]
            self.link()
        return self._hooks.counts

    def log_results(self) -> list[tuple[int, Status]]:
        """Logs uid and result of each tick of a node from now on, in order; the caller empties the list."""
        if self._hooks.log is None:
            self._hooks.log = []
            self.link()
        return self._hooks.log

    def profile(self, profile: Profile | None) -> None:
        """Measures each node with a `Profile` from the next tick on; None ends it."""
        self._hooks.profile = profile
        self.link()

    def debug(self, agent: Agent | None) -> None:
        """Attaches a debugger, which nodes ask before and after their ticks; None detaches it.

        The agent chooses the nodes with its `Wiring`, at any time, also within a tick.
        """
        self._ways.debug(agent)

    def publish_groot2(self, port: int = 1667, host: str = "127.0.0.1") -> Groot2Publisher:
        """Serves the tree to Groot2, and to other clients of its protocol, until the result is closed."""
        return Groot2Publisher(self, port, host)

    def continue_at(self, tick: int) -> None:
        """Counts ticks from this number on, between two ticks."""
        self.tick_number = self._ended_tick = tick

    @property
    def is_ticking(self) -> bool:
        """Whether a tick is in progress."""
        return self._ended_tick != self.tick_number

    def rewire(self) -> None:
        """Looks up again how each node is ticked, also for a tick in progress."""
        self._ways.rewire()

    def entry_of(self, node: Node, inner: Execute) -> Execute:
        """Returns the function that ticks a node together with its hooks; `inner` is the node's own."""
        return self._hooks.entry(node, inner)

    def entries_of(self, nodes: Sequence[Node]) -> list[Execute]:
        """Returns the functions that tick nodes together with their hooks."""
        return self._hooks.entries(nodes)

    def link(self) -> None:
        """Looks up again how each node is ticked, after hooks or observers changed."""
        self._ways.link()

    def linked_once(self) -> AbstractContextManager[None]:
        """Returns a context, between two ticks, at whose end `link` takes effect once."""
        return self._ways.linked_once()

    def forget_code(self, node: Node) -> None:
        """Drops generated code in which a node's functions are, after one of them was replaced."""
        self._ways.forget_code(node)

    def link_around(self, uid: int | None) -> None:
        """Looks up again how one node is ticked, or all (None), after a hook came or went."""
        self._ways.link_around(uid)

    def generated_source(self) -> str:
        """Generates, between two ticks, what is still to be generated; returns all code for inspection."""
        return self._ways.source()

    def generate_code(self, *, on: bool) -> None:
        """Switches generated code on or off, from the next tick on; see `tree_gardener.generated`."""
        self._ways.generate(on=on)
