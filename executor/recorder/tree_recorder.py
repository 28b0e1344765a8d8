"""Records a tree: its nodes, each tick, each write to the blackboard in order, and its state at a moment."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.values import NO_WRITE, canonical, fingerprint, json_of, value_json
from tree_gardener import Status
from tree_gardener.py_trees_board import PREFIX

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from tree_gardener import TickChanges, TickError, Tree
    from tree_gardener.blackboard import Entry
    from tree_gardener.profiling import NodeTime

    Write = Callable[[str, str, Mapping[str, Any]], None]

__all__ = ["STATUS_CODES", "TreeRecorder"]

STATUS_CODES: Final[dict[Status, int]] = {
    Status.IDLE: 0,
    Status.RUNNING: 1,
    Status.SUCCESS: 2,
    Status.FAILURE: 3,
    Status.SKIPPED: 4,
}
_PLAIN: Final = (bool, int, float, str, type(None))
_Row = tuple[str, str, str, str, bool, int]
_Form = tuple[str, str, str, str | None]


class TreeRecorder:
    """Writes a tree into a recording, from now on.

    A tick is noted while it happens and written by `flush`, so that ticks are not slower for it.

    Args:
        tree: the tree.
        write: is called with topic, name of the type, and fields of each message.
        now_ns: returns the simulated time in ns.
        describe: returns a short text for a value without a JSON form.
        generation: the number of the tree in the run; uids mean nothing without it.
    """

    def __init__(
        self,
        tree: Tree,
        write: Write,
        now_ns: Callable[[], int],
        describe: Callable[[Any], str],
        generation: int = 1,
    ) -> None:
        self._tree = tree
        self._write = write
        self._now_ns = now_ns
        self._describe = describe
        self._generation = generation
        self._rows: list[_Row] = []
        self._forms: list[_Form] = []
        self._ticks: list[tuple[int, TickChanges, list[_Row], list[_Form], float]] = []
        self._left_out_s = 0.0
        self._held: dict[int, tuple[Entry, str]] = {}
        tree.journal_writes(self._written)
        tree.observe(self._ticked)
        self._rows, self._forms = [], []  # what was there before has no writer; the keyframe has it
        self.restate(generation)

    @property
    def waiting(self) -> int:
        """The number of noted ticks that are not written."""
        return len(self._ticks)

    def flush(self) -> None:
        """Writes the ticks that were noted."""
        ticks, self._ticks = self._ticks, []
        for tick in ticks:
            self._write_tick(*tick)

    def leave_out(self, duration_s: float) -> None:
        """Leaves out a hold of the debugger from the duration of the tick that is made."""
        self._left_out_s += duration_s

    def restate(self, generation: int) -> None:
        """Writes the tree and its state again, as the begin of another recording."""
        self.flush()
        self._generation = generation
        self._write_tree()
        self.keyframe(0, b"")

    def raised(self, error: TickError) -> None:
        """Writes an exception of an action."""
        fault = {"kind": "exception", "file": error.file, "line": error.line or 0, "message": error.message}
        fault |= {"traceback": error.traceback_text, "uid": self._uid(error.path)}
        self._tell("/bt/fault", "Fault", fault)

    def says(self, level: str, text: str, path: str = "", source: str = "session") -> None:
        """Writes a line about a node, or about none."""
        line = {"source": source, "level": level, "text": text, "uid": self._uid(path)}
        self._tell("/bt/log", "Log", line)

    def profiled(self, ticks: int, times: Sequence[NodeTime]) -> None:
        """Writes the times of nodes in the ticks since the last call."""
        fields = {
            "generation": self._generation,
            "ticks": ticks,
            "uid": [time.uid for time in times],
            "calls": [time.calls for time in times],
            "total_ms": [time.total_s * 1000.0 for time in times],
            "self_ms": [time.self_s * 1000.0 for time in times],
        }
        self._tell("/bt/profile", "Profile", fields)

    def keyframe(self, step: int, world: bytes) -> None:
        """Writes the whole state at this moment."""
        entries = [
            [board.path, key, entry.type_name, json.loads(self._json(entry))]
            for board in self._tree.boards
            for key, entry in board.entries.items()
        ]
        entries += [
            [*place, kind, json.loads(value_json(value, self._describe))]
            for place, (kind, value) in self._tree.outside_entries().items()
        ]
        fields = {
            "step": step,
            "tick": self._tree.tick_number,
            "generation": self._generation,
            "status": bytes(STATUS_CODES[node.status] for node in self._tree.nodes),
            "blackboard_json": json.dumps(entries, ensure_ascii=False, separators=(",", ":")),
            "world": world,
        }
        self._tell("/bt/keyframe", "Keyframe", fields)

    def _tell(self, topic: str, name: str, fields: dict[str, Any]) -> None:
        self.flush()
        self._write(topic, name, {"stamp": self._now_ns(), **fields})

    def _uid(self, path: str) -> int:
        return next((node.uid for node in self._tree.nodes if node.path == path), 0) if path else 0

    def _json(self, entry: Entry) -> str:
        return value_json(None if entry.type_name == "empty" else entry.value, self._describe)

    def _write_tree(self) -> None:
        nodes = self._tree.nodes
        fields = {
            "generation": self._generation,
            "uid": [node.uid for node in nodes],
            "parent": [node.parent.uid if node.parent is not None else 0 for node in nodes],
            "type": [node.type for node in nodes],
            "kind": [node.KIND.value for node in nodes],
            "name": [node.name for node in nodes],
            "path": [node.path for node in nodes],
            "node_id": [node.node_id for node in nodes],
            "tree_id": [node.tree_id for node in nodes],
            "ports_json": [canonical(dict(node.ports)) or "{}" for node in nodes],
        }
        self._tell("/bt/tree", "Tree", fields)

    def _written(self, entry: Entry, writer: int) -> None:
        """Copies a written value immediately, since an action may change it later."""
        is_removed = entry.board.entries.get(entry.key) is not entry
        is_empty = is_removed or entry.type_name == "empty"
        form = None if is_empty else canonical(entry.value)
        self._add(entry, writer, form, is_removed=is_removed, is_empty=is_empty)
        if form is not None and not isinstance(entry.value, _PLAIN):
            self._held[id(entry)] = (entry, form)
        elif self._held:
            self._held.pop(id(entry), None)

    def _add(
        self,
        entry: Entry,
        writer: int,
        form: str | None,
        *,
        is_removed: bool = False,
        is_empty: bool = False,
    ) -> None:
        scope, kind = entry.board.path, entry.type_name
        text = "null" if is_empty else json_of(entry.value, form, self._describe)
        self._rows.append((scope, entry.key, kind, text, is_removed, writer))
        self._forms.append((scope, entry.key, kind, form))

    def _find_changed_in_place(self) -> None:
        for key, (entry, form) in list(self._held.items()) if self._held else ():
            now = canonical(entry.value)
            if now is not None and now != form:
                self._held[key] = (entry, now)
                self._add(entry, NO_WRITE, now)

    def _outside(self, changes: TickChanges) -> None:
        """Notes the entries of py_trees, of which nobody knows the writer."""
        for entry in changes.blackboard:
            if entry.scope.startswith(PREFIX):
                form = None if entry.removed else canonical(entry.value)
                text = "null" if entry.removed else json_of(entry.value, form, self._describe)
                self._rows.append((entry.scope, entry.key, entry.type, text, entry.removed, NO_WRITE))
                self._forms.append((entry.scope, entry.key, entry.type, form))

    def _ticked(self, changes: TickChanges) -> None:
        self._find_changed_in_place()
        self._outside(changes)
        duration_ms = max(0.0, changes.duration_s - self._left_out_s) * 1000.0
        self._ticks.append((self._now_ns(), changes, self._rows, self._forms, duration_ms))
        self._rows, self._forms, self._left_out_s = [], [], 0.0

    def _write_tick(
        self, stamp: int, changes: TickChanges, rows: list[_Row], forms: list[_Form], duration_ms: float
    ) -> None:
        if rows:
            scopes, keys, kinds, texts, removed, writers = (
                list(column) for column in zip(*rows, strict=True)
            )
            fields = {"stamp": stamp, "tick": changes.tick, "scope": scopes, "key": keys, "type": kinds}
            fields |= {"value_json": texts, "removed": removed, "writer_uid": writers}
            self._write("/bt/blackboard", "Blackboard", fields)
        if changes.forced:
            at = {"stamp": stamp, "generation": self._generation, "tick": changes.tick}
            self._write("/bt/forced", "Forced", at | {"uid": changes.forced})
        changed_uid, changed_status = _columns(changes.changed)
        flashed_uid, flashed_status = _columns(changes.flashed)
        tick = {
            "stamp": stamp,
            "generation": self._generation,
            "number": changes.tick,
            "changed_uid": changed_uid,
            "changed_status": changed_status,
            "flashed_uid": flashed_uid,
            "flashed_status": flashed_status,
            "duration_ms": duration_ms,
            "fingerprint": fingerprint(
                changes.tick,
                zip(changed_uid, changed_status, strict=True),
                zip(flashed_uid, flashed_status, strict=True),
                forms,
            ),
        }
        self._write("/bt/tick", "Tick", tick)


def _columns(pairs: list[tuple[int, Status]]) -> tuple[list[int], bytes]:
    """Returns the uids and the codes of the statuses of nodes."""
    if not pairs:
        return [], b""
    uids, statuses = zip(*pairs, strict=True)
    return list(uids), bytes(map(STATUS_CODES.__getitem__, statuses))
