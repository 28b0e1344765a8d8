"""Observation: the changes that observers receive after each tick."""

import dataclasses
import time
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, TypeVar

from tree_gardener.blackboard import EMPTY, Blackboard, Entry, Journal
from tree_gardener.node import Flash, Mark, Node
from tree_gardener.py_trees_board import PyTreesBoard
from tree_gardener.status import FAILURE, IDLE, RUNNING, SKIPPED, SUCCESS, Status

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

T = TypeVar("T")


@dataclasses.dataclass(frozen=True)
class BlackboardChange:
    """A blackboard entry that was written or removed.

    Attributes:
        scope: the path of the SubTree that stores the entry; "" for the root.
        key: the name of the entry in that scope.
        type: the name of its type; ``empty`` if it has no value.
        value: the value itself, not a copy; None if there is none.
        removed: whether it was removed.
        writer_uid: the uid of the node that wrote it last; 0 if it was written from outside.
    """

    scope: str
    key: str
    type: str
    value: Any
    removed: bool
    writer_uid: int


class TickChanges:
    """The changes of one tick.

    Attributes:
        tick: number of the tick, from 1.
        changed: nodes whose status differs from that after the previous tick, with the new status.
        flashed: nodes that returned a status within the tick and no longer have it after the tick: a SUCCESS
            or FAILURE that the parent reset, or SKIPPED. A node that was ticked twice may be listed twice.
        forced: the uids of the nodes whose result in this tick was forced by a debugger.
        blackboard: entries that were written, also between the tick before and this one.
        duration_s: the duration of the tick.
        node_times_s: the seconds that each node took, including the nodes below it, by uid; empty unless
            requested.
    """

    __slots__ = ("blackboard", "changed", "duration_s", "flashed", "forced", "node_times_s", "tick")

    def __init__(
        self,
        tick: int,
        changed: list[tuple[int, Status]],
        flashed: list[tuple[int, Status]],
        blackboard: list[BlackboardChange],
        duration_s: float,
    ) -> None:
        self.tick = tick
        self.changed = changed
        self.flashed = flashed
        self.blackboard = blackboard
        self.duration_s = duration_s
        self.forced: list[int] = []
        self.node_times_s: dict[int, float] = {}

    def __repr__(self) -> str:
        return f"TickChanges(tick={self.tick}, changed={self.changed}, flashed={self.flashed})"


Observer = Callable[[TickChanges], None]


class Recorder:
    """Collects the changes of a tree while it is observed.

    Attributes:
        touched: nodes that started, or whose reported status was reset.
        results: reports of what nodes returned in this tick, except RUNNING, in order.
        forced: the uids of the nodes whose result in this tick was forced.
        is_disturbed: whether changes were reported within a tick, since a node halted or ticked the tree.
        writes: is called with each write to the blackboard as it happens, and the uid of its writer.
        watch: is called likewise, also while the tree is not observed; set it by `watch_writes`.
    """

    __slots__ = (
        *("entries", "forced", "is_disturbed", "is_ticking", "observers", "outside", "results", "touched"),
        *("tree", "watch", "writes"),
    )

    def __init__(self, tree: "Tree") -> None:
        self.tree = tree
        self.observers: list[Observer] = []
        self.outside = PyTreesBoard()
        self.touched: list[Node] = []
        self.results: list[Mark] = []
        self.forced: list[int] = []
        self.is_ticking = self.is_disturbed = False
        self.entries: dict[int, tuple[Entry, int]] = {}
        self.writes: Journal | None = None
        self.watch: Journal | None = None

    def attach(self) -> None:
        """Starts recording. All nodes that are not IDLE, and all entries, count as changed."""
        self.results.clear()
        for node in self.tree.nodes:
            uid = node.uid
            node.marks = (
                (node, ((uid, SUCCESS),)),
                (node, ((uid, FAILURE),)),
                (node, ((uid, SKIPPED),)),
            )
            node.reported = IDLE
            node.journal = self
        # All nodes, since one that the current tick ticks without reports may change its status afterwards.
        self.touched[:] = self.tree.nodes
        self.outside.begin(self.tree.nodes)
        for board in self.tree.boards:
            board.journal = self.written
            for entry in board.entries.values():
                self.written(entry, 0)

    def detach(self) -> None:
        """Stops recording."""
        for node in self.tree.nodes:
            node.journal = None
        for board in self.tree.boards:
            board.journal = self.watch
        self.touched.clear()
        self.forced.clear()
        self.entries = {}

    def watch_writes(self, watch: Journal | None) -> None:
        """Calls a function with each write to the blackboard from now on; None ends it."""
        self.watch = watch
        if not self.observers:
            for board in self.tree.boards:
                board.journal = watch

    def reset(self, children: Iterable[Node]) -> None:
        """Halts the children that are RUNNING and makes all of them IDLE, like `Control.reset_children`."""
        for child in children:
            if child.status is RUNNING:
                child.stop()
            child.status = IDLE
            if child.reported is not IDLE:
                self.touched.append(child)

    def reset_done(self, children: Iterable[Node]) -> None:
        """Makes all children IDLE; none of them may be RUNNING."""
        for child in children:
            child.status = IDLE
            if child.reported is not IDLE:
                self.touched.append(child)

    def written(self, entry: Entry, writer: int) -> None:
        """Records that an entry was written or removed."""
        self.entries[id(entry)] = (entry, writer)
        if self.writes is not None:
            self.writes(entry, writer)
        if self.watch is not None:
            self.watch(entry, writer)

    def tick(self, function: Callable[[], T]) -> T:
        """Ticks the tree and notifies the observers, also when the tick raises."""
        start_s = time.perf_counter()
        outer, self.is_ticking = self.is_ticking, True
        try:
            status = function()
        except BaseException:
            self.is_ticking = outer
            # The exception kept the nodes above the failed one from reporting their results.
            self.touched += self.tree.nodes
            self.tell(time.perf_counter() - start_s)
            raise
        self.is_ticking = outer
        self.tell(time.perf_counter() - start_s)
        return status

    def tell(self, duration_s: float) -> None:
        """Notifies the observers of the changes since the last call."""
        changes = self.collect(duration_s)
        for observer in tuple(self.observers):
            observer(changes)

    def collect(self, duration_s: float) -> TickChanges:
        """Returns the changes, computed from the recorded events."""
        nodes = self.tree.nodes
        touched, results = self.touched.copy(), self.results.copy()
        self.touched.clear()  # generated code holds the lists
        self.results.clear()
        touched.append(nodes[0])
        is_disturbed, self.is_disturbed = self.is_disturbed, self.is_ticking
        if is_disturbed:
            touched += nodes
        flashed: list[Flash] = []
        for node, flashes in results:
            if node.status is IDLE and not is_disturbed:
                flashed += flashes
                continue
            for flash in flashes:  # each node may still have its result
                below = nodes[flash[0] - 1]  # uids count from 1 in the order of the nodes
                if below.status is flash[1]:
                    touched.append(below)
                else:
                    flashed.append(flash)
        changed: list[tuple[int, Status]] = []
        for node in touched:
            status = node.status
            if status is not node.reported:
                node.reported = status
                changed.append((node.uid, status))
        entries: list[BlackboardChange] = []
        if self.entries:
            entries = [change(entry, writer) for entry, writer in self.entries.values()]
            self.entries = {}
        if self.outside.is_used:
            entries += [_outside(place, value) for place, value in self.outside.changes()]
        changes = TickChanges(self.tree.tick_number, changed, flashed, entries, duration_s)
        if self.forced:
            changes.forced, self.forced = self.forced, []
        if self.tree.node_times_s is not None:
            changes.node_times_s = self.tree.node_times_s
            self.tree.node_times_s = {}
        return changes


def _outside(place: tuple[str, str], value: tuple[str, Any] | None) -> BlackboardChange:
    """Returns an entry of py_trees in the form that observers receive; nobody knows who wrote it."""
    kind, shown = value or ("empty", None)
    return BlackboardChange(*place, kind, shown, removed=value is None, writer_uid=0)


def change(entry: Entry, writer: int) -> BlackboardChange:
    """Returns an entry in the form that observers receive."""
    board: Blackboard = entry.board
    value = None if entry.value is EMPTY else entry.value
    removed = board.entries.get(entry.key) is not entry
    return BlackboardChange(board.path, entry.key, entry.type_name, value, removed, writer)
