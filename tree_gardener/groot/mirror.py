"""Copies of statuses, transitions and blackboards; the ticking thread writes, and another one reads."""

import collections
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Final

from tree_gardener.board_json import value_to_json
from tree_gardener.groot.document import instances
from tree_gardener.groot.protocol import pack_statuses, pack_transition, wire_status
from tree_gardener.observe import TickChanges
from tree_gardener.status import SKIPPED, Status

if TYPE_CHECKING:
    from tree_gardener.tree import Tree

Pack = Callable[[Any], bytes]
MOST_TRANSITIONS: Final = 1000


class Mirror:
    """The state of a tree after its last tick, as clients see it.

    Args:
        tree: the tree.
        pack: writes a value as MessagePack.
    """

    def __init__(self, tree: "Tree", pack: Pack) -> None:
        self._tree = tree
        self._pack = pack
        self._lock = threading.Lock()
        self._order = [node.uid for nodes in instances(tree) for node in nodes]
        self._statuses = dict.fromkeys(self._order, 0)
        self._boards: dict[str, dict[str, Any]] = {}
        self._transitions: collections.deque[bytes] = collections.deque(maxlen=MOST_TRANSITIONS)
        self._recorded_from_ns: int | None = None

    def read(self) -> None:
        """Copies the tree as it is: between two ticks, while it does not tick, or while it is held."""
        with self._lock:
            for node in self._tree.nodes:
                self._statuses[node.uid] = wire_status(node.status, self._statuses[node.uid])
            self._boards = {
                board.path: {key: self._form(entry.value) for key, entry in sorted(board.entries.items())}
                for board in self._tree.boards
            }

    def ticked(self, changes: TickChanges) -> None:
        """Copies the changes of a tick.

        As in BehaviorTree.CPP, a skipped node keeps what it had. Other than there, a node that became
        RUNNING and was halted in one tick is not seen to have been RUNNING.
        """
        with self._lock:
            for uid, status in changes.flashed:
                if status is not SKIPPED:
                    self._set(uid, status)
                    self._set(uid, self._tree.nodes[uid - 1].status)
            for uid, status in changes.changed:
                self._set(uid, status)
            for entry in changes.blackboard:
                board = self._boards.setdefault(entry.scope, {})
                if entry.removed:
                    board.pop(entry.key, None)
                else:
                    board[entry.key] = self._form(entry.value)

    def _form(self, value: Any) -> Any:
        """Returns the form in which a value is sent; None if it has none."""
        try:
            form = value_to_json(value)
            self._pack(form)
        except (Exception, SystemExit):  # the conversion of a user's type, or a number of any size
            return None
        return form

    def _set(self, uid: int, status: Status) -> None:
        before = self._statuses[uid]
        now = self._statuses[uid] = wire_status(status, before)
        if now != before and self._recorded_from_ns is not None:
            time_us = max(time.time_ns() - self._recorded_from_ns, 0) // 1000
            self._transitions.append(pack_transition(time_us, uid, status))

    def statuses(self) -> bytes:
        """Returns the statuses of all nodes, instance by instance."""
        with self._lock:
            return pack_statuses((uid, self._statuses[uid]) for uid in self._order)

    def blackboards(self, names: list[str]) -> dict[str, dict[str, Any] | None]:
        """Returns scopes by name: a path, for the root also its tree's ID. An empty scope is None."""
        with self._lock:
            known = {
                self._tree.nodes[0].tree_id: "",
                **{board.path: board.path for board in self._tree.boards},
            }
            wanted = {name: self._boards.get(known[name], {}) for name in names if name in known}
            return {name: dict(board) or None for name, board in wanted.items()}

    def start_recording(self) -> int:
        """Keeps transitions from now on; returns the time in microseconds since the epoch."""
        with self._lock:
            self._transitions.clear()
            self._recorded_from_ns = time.time_ns()
            return self._recorded_from_ns // 1000

    def stop_recording(self) -> None:
        """Keeps no more transitions; those that were kept can still be taken."""
        with self._lock:
            self._recorded_from_ns = None

    def take_transitions(self) -> bytes:
        """Returns the transitions since the last call, at most the last 1,000."""
        with self._lock:
            taken = b"".join(self._transitions)
            self._transitions.clear()
            return taken
