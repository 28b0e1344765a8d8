"""Writes a tree whose changes come one by one into a recording."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, Protocol

from executor.recorder.moment import Moment
from executor.recorder.outside.errors import OutsideError
from executor.recorder.outside.steps import STATUS_WORDS, Steps

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from executor.recorder.outside.steps import Change, Step
    from executor.recorder.outside.tree_xml import LoggedTree

__all__ = ["LONGEST_NS", "MOST_BACK_NS", "EntryRow", "TimeLine", "TreeLog", "TreeWriter"]

MOST_BACK_NS: Final = 1_000_000_000
LONGEST_NS: Final = 10_000_000 * 1_000_000_000
KEYFRAME_NS: Final = 5_000_000_000
MOST_LINE: Final = 4096


EntryRow = tuple[str, str, str, str, bool]
"""Scope, key, type, value as JSON, and whether the entry was removed."""


class TreeWriter(Protocol):
    """Takes the messages of a tree, such as a `RecordingWriter`."""

    def record(self, topic: str, name: str, fields: dict[str, Any]) -> None:
        """Writes a message."""

    def attach(self, name: str, media_type: str, data: bytes) -> None:
        """Writes a file."""


class TimeLine:
    """Makes times of a log begin at 0 and never decrease.

    Several threads may write a log, so times up to a second before the last one count as the last one.
    """

    def __init__(self, name: str) -> None:
        self._name = name
        self._first_ns: int | None = None
        self._base_ns = 0
        self._last_ns = 0

    def at(self, t_ns: int, place: int) -> int:
        """Returns a time of the log in the recording.

        Raises:
            OutsideError: the times run back, or span longer than any log.
        """
        if self._first_ns is None:
            self._first_ns = t_ns
        t_ns += self._base_ns - self._first_ns
        if t_ns < self._last_ns - MOST_BACK_NS:
            back_s = (self._last_ns - t_ns) * 1e-9
            hint = "Was the clock set meanwhile? Split the log there."
            raise OutsideError(
                "times_run_back", self._name, place, f"the time runs back by {back_s:.6g} s", hint
            )
        if t_ns > LONGEST_NS:
            text = f"the time is {t_ns * 1e-9:.6g} s after the begin"
            raise OutsideError("damaged", self._name, place, text, "No log is as long.")
        self._last_ns = max(self._last_ns, t_ns)
        return self._last_ns

    def join(self, gap_ns: int) -> None:
        """Places the next time, whatever it is, so long after the last one."""
        self._base_ns, self._first_ns = self._last_ns + gap_ns, None


class TreeLog:
    """Writes trees, their changes, and lines; times are in ns from the begin of the recording.

    Args:
        writer: takes the messages.
        name: the name of the log in errors.
        generation: the number of the last tree in the run.
    """

    def __init__(self, writer: TreeWriter, name: str, generation: int = 0) -> None:
        self._writer, self._name = writer, name
        self._moment = Moment()
        self._steps = Steps()
        self._generation = generation
        self._ticks = 0
        self._numbers: dict[int, int] = {}
        self._keyframe_ns = 0

    def tree(self, t_ns: int, tree: LoggedTree) -> None:
        """Begins another tree; all its nodes are idle."""
        self.end_step()
        self._generation += 1
        self._steps = Steps()
        self._numbers = tree.numbers
        fields = {"stamp": t_ns, "generation": self._generation, **tree.columns}
        self._record("/bt/tree", "Tree", fields)
        if tree.xml:
            self._writer.attach(f"tree_{self._generation}.xml", "application/xml", tree.xml)
        self._keyframe(t_ns)

    def change(self, t_ns: int, number: int, status: int, place: int) -> None:
        """Takes a change of a node by its number in the log.

        Raises:
            OutsideError: there is no such node or status.
        """
        uid = self._numbers.get(number)
        if uid is None or not 0 <= status < len(STATUS_WORDS):
            text = f"node {number} is not in the tree" if uid is None else f"there is no status {status}"
            raise OutsideError("damaged", self._name, place, text, "The file is damaged there.")
        if (ended := self._steps.take(t_ns, uid, status)) is not None:
            self._step(ended)

    @property
    def statuses(self) -> Mapping[int, int]:
        """The statuses of the nodes that have changed, by our uids."""
        return self._steps.statuses

    def changes(self, changes: Iterable[Change]) -> None:
        """Takes changes of nodes of this tree, by our uids and in the order of their times."""
        for ended in self._steps.take_all(changes):
            self._step(ended)

    def entries(self, t_ns: int, rows: Sequence[EntryRow]) -> None:
        """Writes entries of the blackboard that have changed."""
        self.end_step()
        if not rows:
            return
        scopes, keys, kinds, texts, removed = (list(column) for column in zip(*rows, strict=True))
        fields = {"stamp": t_ns, "tick": self._ticks, "scope": scopes, "key": keys, "type": kinds}
        fields |= {"value_json": texts, "removed": removed, "writer_uid": [0] * len(rows)}
        self._record("/bt/blackboard", "Blackboard", fields)

    def line(self, t_ns: int, source: str, level: str, text: str) -> None:
        """Writes a line of the console."""
        self.end_step()
        line = {"stamp": t_ns, "source": source, "level": level, "text": text[:MOST_LINE], "uid": 0}
        self._record("/bt/log", "Log", line)

    def end_step(self) -> None:
        """Ends the tick that is open."""
        if (ended := self._steps.end()) is not None:
            self._step(ended)

    def _step(self, step: Step) -> None:
        self._ticks += 1
        fields = {
            "stamp": step.t_ns,
            "generation": self._generation,
            "number": self._ticks,
            "changed_uid": [uid for uid, _ in step.changed],
            "changed_status": bytes(status for _, status in step.changed),
            "flashed_uid": [uid for uid, _ in step.flashed],
            "flashed_status": bytes(status for _, status in step.flashed),
            "duration_ms": step.duration_ns * 1e-6,
            "fingerprint": 0,
        }
        self._record("/bt/tick", "Tick", fields)
        if step.t_ns - self._keyframe_ns >= KEYFRAME_NS:
            self._keyframe(step.t_ns)

    def _keyframe(self, t_ns: int) -> None:
        self._keyframe_ns = t_ns
        self._record("/bt/keyframe", "Keyframe", self._moment.keyframe(t_ns, 0, b""))

    def _record(self, topic: str, name: str, fields: dict[str, Any]) -> None:
        self._moment.take(name, fields)
        self._writer.record(topic, name, fields)
