"""Sends reports about the tree to the manager: its nodes, ticks, blackboard, faults and end."""

from __future__ import annotations

import errno
import time
from typing import TYPE_CHECKING, Any, Final

from executor import child_messages
from executor.application.last_tick import LastTick
from executor.application.preview import preview
from executor.messages import BlackboardEntry, TreeNode
from tree_gardener import BlackboardChange, LoadError, Status, TickError
from tree_gardener.debugging.debugger import lead_to
from tree_gardener.errors import describe, traceback_of
from tree_gardener.stubs import stubs_sentence, unwritten

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from executor.application.locate import Place
    from executor.messages import FaultKind, FinishReason, NodeStatus
    from tree_gardener import TickChanges, Tree
    from tree_gardener.node import Node

__all__ = ["Reporter", "describe_tree"]

BLACKBOARD_INTERVAL_S: Final = 0.1
IDLE_TICK_INTERVAL_S: Final = 0.05
SAME_FAULT_INTERVAL_S: Final = 1.0
MAX_LOAD_FAULTS: Final = 20
_NAMES: Final[dict[Status, NodeStatus]] = {
    Status.IDLE: "IDLE",
    Status.RUNNING: "RUNNING",
    Status.SUCCESS: "SUCCESS",
    Status.FAILURE: "FAILURE",
    Status.SKIPPED: "SKIPPED",
}


Report = (
    child_messages.Tree
    | child_messages.Tick
    | child_messages.HeldInPython
    | child_messages.Blackboard
    | child_messages.Log
    | child_messages.Fault
    | child_messages.Finished
)
"""Messages that a reporter sends."""


def describe_tree(tree: Tree) -> list[TreeNode]:
    """Returns the description of each node of the tree, in pre-order."""
    return [
        TreeNode(
            uid=node.uid,
            parent=node.parent.uid if node.parent is not None else 0,
            type=node.type,
            kind=node.KIND.value,
            name=node.name,
            path=node.path,
            node_id=node.node_id,
            tree_id=node.tree_id,
        )
        for node in tree.nodes
    ]


class Reporter:
    """Makes messages for the manager from the events of a tree.

    Args:
        send: is called with each message.
        now_s: returns the simulated time in s.
        clock: returns the time in s that limits the rate of messages; it is real time in a session.
    """

    def __init__(
        self,
        send: Callable[[Report], None],
        now_s: Callable[[], float],
        *,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._send = send
        self._now_s = now_s
        self._clock = clock
        self._entries: dict[tuple[str, str], BlackboardChange] = {}
        self._entries_due_s = 0.0
        self._ticks_due_s = 0.0
        self._forced: list[int] = []
        self._faults_s: dict[tuple[str, str], float] = {}
        self._stubs = ""
        self._last = LastTick()
        self._nodes: Sequence[Node] = ()
        self._told: dict[tuple[str, str], object] = {}
        self.take_held_s: Callable[[], float] = lambda: 0.0
        """Returns for how long a debugger held the tree in the last tick; it is no part of the tick."""

    def tree(self, tree: Tree) -> None:
        """Reports the nodes of a new tree."""
        self._nodes = tree.nodes
        self._send(child_messages.Tree(describe_tree(tree)))

    def follow(self, tree: Tree) -> None:
        """Reports a tree that has taken over from another one, with all that it has."""
        self._last = LastTick()
        self.restate(tree)

    def restate(self, tree: Tree) -> None:
        """Reports a tree with all that it has, and its last tick."""
        self.tree(tree)
        statuses = [(node.uid, node.status) for node in tree.nodes if node.status is not Status.IDLE]
        self._send(
            child_messages.Tick(
                n=tree.tick_number,
                t=self._now_s(),
                changed=_named(statuses),
                flashed=[],
                duration_ms=0.0,
                past=_named(self._last.past.items()),
            )
        )
        self._entries.clear()
        self._told.clear()
        self.held(tree)

    def stubs(self, tree: Tree) -> None:
        """Reports the actions of a new tree that are not written yet."""
        if names := unwritten(tree):
            self._stubs = stubs_sentence(names)
            self._send(child_messages.Log("warning", self._stubs))

    def tolerated(self, node: Node, message: str) -> None:
        """Reports a tolerated mistake of an action; the engine reports each once."""
        self._send(child_messages.Log("warning", message, node.node_id, node.path))

    def ended(self, status: Status) -> None:
        """Reports that the root succeeded, failed or was skipped, and the node that decided it."""
        text = f"The tree ended with {status.name}. {self._stubs}".strip()
        self.finished(status, "root_finished", text, self._last.decider(self._nodes, status))

    def ticked(self, changes: TickChanges) -> None:
        """Reports a tick, or the halt after it."""
        now_s = self._clock()
        for entry in changes.blackboard:
            self._entries[entry.scope, entry.key] = entry
            self._told[entry.scope, entry.key] = entry.value
        held_s = self.take_held_s()
        has_past_changed = self._last.take(changes)
        has_forced_changed = changes.forced != self._forced
        self._forced = changes.forced
        is_news = changes.changed or changes.flashed or has_past_changed or has_forced_changed
        if is_news or now_s >= self._ticks_due_s:
            self._ticks_due_s = now_s + IDLE_TICK_INTERVAL_S
            self._send(
                child_messages.Tick(
                    n=changes.tick,
                    t=self._now_s(),
                    changed=_named(changes.changed),
                    flashed=_named(changes.flashed),
                    duration_ms=max(0.0, changes.duration_s - held_s) * 1000.0,
                    past=_named(self._last.past.items()),
                    forced=changes.forced,
                )
            )
        self.flush()

    def written(self, tree: Tree, scope: str, key: str) -> None:
        """Reports an entry that was written from outside, between two ticks."""
        board = tree.blackboard.scope(scope) if scope else tree.blackboard
        entry = board.find(key)
        if entry is not None:
            changed = BlackboardChange(scope, key, entry.type_name, entry.value, removed=False, writer_uid=0)
            self._entries[scope, key] = changed
        self.flush(now=True)

    def held(self, tree: Tree) -> None:
        """Reports the entries that a held tick has written; only another value counts as written."""
        entries = {
            (board.path, key): (entry.type_name, entry.value)
            for board in tree.boards
            for key, entry in board.entries.items()
        }
        entries.update(tree.outside_entries())
        for place, (kind, value) in entries.items():
            if place not in self._told or self._told[place] is not value:
                self._told[place] = value
                self._entries[place] = BlackboardChange(*place, kind, value, removed=False, writer_uid=0)
        self.flush(now=True)

    def held_in_python(self, tree: Tree, node: Node) -> None:
        """Reports a tree within a tick, at a node whose Python is held."""
        statuses = _named((each.uid, each.status) for each in tree.nodes if each.status is not Status.IDLE)
        lead = list(lead_to(node))
        self._send(child_messages.HeldInPython(node.uid, lead, tree.tick_number, statuses))
        self.held(tree)

    def flush(self, *, now: bool = False) -> None:
        """Sends the changed entries of the blackboard, at a limited rate; immediately if `now` is set."""
        if not self._entries or (self._clock() < self._entries_due_s and not now):
            return
        self._entries_due_s = self._clock() + BLACKBOARD_INTERVAL_S
        entries, self._entries = self._entries, {}
        self._send(child_messages.Blackboard([_entry(change) for change in entries.values()]))

    def raised(self, error: TickError) -> None:
        """Reports an exception of an action; the same exception is reported at most once a second."""
        key, now_s = (error.path, error.message), self._clock()
        if now_s < self._faults_s.get(key, 0.0):
            return
        self._faults_s[key] = now_s + SAME_FAULT_INTERVAL_S
        self._fault(
            "exception",
            error.message,
            hint=_hint(error.cause),
            node_id=error.node_id,
            tree_id=error.tree_id,
            node_path=error.path,
            file=error.file,
            line=error.line,
            traceback=error.traceback_text,
        )

    def not_loaded(self, error: BaseException, place: Place) -> None:
        """Reports why the application cannot be loaded."""
        if isinstance(error, TickError):
            self.raised(error)
        elif isinstance(error, LoadError):
            for diagnostic in error.diagnostics[:MAX_LOAD_FAULTS]:
                self._fault(
                    "load",
                    f"{diagnostic.message}",
                    hint=diagnostic.hint,
                    node_id=diagnostic.node_id,
                    tree_id=diagnostic.tree,
                    file=diagnostic.file,
                    line=diagnostic.line,
                    traceback=_cause_text(error),
                )
        else:
            self.broke_out("load", error, place)

    def broke_out(self, kind: FaultKind, error: BaseException, place: Place) -> None:
        """Reports an exception that no tick handles: `sys.exit` in an action, or an error of BT Studio."""
        self._fault(kind, describe(error), **_place(place) | {"traceback": traceback_of(error)})

    def hangs(self, message: str, place: Place) -> None:
        """Reports a tick that does not return."""
        hint = "update() must return soon: let it return RUNNING while work continues."
        self._fault("timeout", message, hint=hint, **_place(place))

    def finished(
        self, status: Status | None, reason: FinishReason, message: str, decider: Node | None = None
    ) -> None:
        """Reports that the run ended by itself; `decider` is the node from which the root has its status."""
        self.flush(now=True)
        name = _NAMES[status] if status is not None else "FAILURE"
        finished = child_messages.Finished(name, reason, message)
        if decider is not None:
            finished.node_path = decider.path
            finished.node_id, finished.tree_id = decider.node_id, decider.tree_id
        self._send(finished)

    def _fault(self, kind: FaultKind, message: str, **fields: Any) -> None:
        self._send(child_messages.Fault(kind, message, **fields))


def _entry(change: BlackboardChange) -> BlackboardEntry:
    value, is_preview = (None, False) if change.removed else preview(change.value)
    return BlackboardEntry(change.scope, change.key, change.type, value, is_preview, change.removed)


def _named(statuses: Iterable[tuple[int, Status]]) -> list[tuple[int, NodeStatus]]:
    return [(uid, _NAMES[status]) for uid, status in statuses]


def _place(place: Place) -> dict[str, Any]:
    return {
        "node_id": place.node_id,
        "tree_id": place.tree_id,
        "node_path": place.node_path,
        "file": place.file,
        "line": place.line,
        "traceback": place.traceback,
    }


def _cause_text(error: BaseException) -> str:
    return traceback_of(error.__cause__) if error.__cause__ else ""


def _hint(cause: BaseException | None) -> str:
    if isinstance(cause, ModuleNotFoundError):
        return f"Install the package that provides '{cause.name}', or correct the import."
    if isinstance(cause, MemoryError):
        return "The application reached its limit of memory."
    if isinstance(cause, OSError) and cause.errno == errno.EFBIG:
        return "The application reached its limit of the size of a file."
    if isinstance(cause, OSError) and cause.errno == errno.ENOSPC:
        return "There is no room left where the application writes; remove what earlier runs left there."
    if isinstance(cause, BlockingIOError):  # fork failed with EAGAIN
        return "The application reached its limit of processes."
    return ""
