"""Reads a recording once, and returns the facts of its run. Memory does not grow with its length."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, BinaryIO, Final, Literal

from mcap.records import Attachment, Channel, Message, Schema

from executor.recorder.cdr import CdrError, decode
from executor.recorder.definitions import OURS
from executor.recorder.reader import RecordReader
from executor.recorder.shelf import PICTURE
from executor.recorder.summary.places import Places

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.recorder.reader import Limits

__all__ = ["Facts", "Result", "facts_of"]

Result = Literal["running", "success", "failure", "error"]
LARGEST_PICTURE_BYTES: Final = 1 << 20
MOST_ROWS: Final = 40
LARGEST_XML_BYTES: Final = 1 << 20
_JPEG: Final = b"\xff\xd8\xff"
_RESULTS: Final[dict[int, Result]] = {1: "running", 2: "success", 3: "failure"}
_READ: Final = {f"{OURS}/msg/{name}" for name in ("Tree", "Tick", "Fault", "Scene", "Poses")} | {PICTURE}


@dataclass
class Facts:
    """A run as a whole.

    Attributes:
        messages: the number of messages.
        from_ns, to_ns: the times of the first and the last one.
        ticks: the number of ticks.
        result: how the run ended: `error` after a fault, else the last status of the root.
        picture: the last JPEG picture of a camera, or nothing; it has not been decoded.
        rows: the first nodes of the tree in its order: depth, and status at the end (0 IDLE to 4 SKIPPED).
        trail, boxes: as `Places` returns them.
        xml: the tree of a log of BehaviorTree.CPP, or nothing.
        is_cut: whether the end of the file is missing.
    """

    messages: int = 0
    from_ns: int = 0
    to_ns: int = 0
    ticks: int = 0
    result: Result = "running"
    picture: bytes = b""
    rows: list[list[int]] = field(default_factory=list)
    trail: list[list[float]] = field(default_factory=list)
    boxes: list[list[float]] = field(default_factory=list)
    xml: bytes = b""
    is_cut: bool = False


def facts_of(file: BinaryIO, name: str, limits: Limits | None = None) -> Facts:
    """Returns the facts of a recording. Unreadable messages are skipped.

    Args:
        file: the recording, at its begin.
        name: its name in errors.
        limits: the largest permitted sizes and counts.

    Raises:
        RecordingError: it is no recording, or hostile.
    """
    reader = RecordReader(file, name) if limits is None else RecordReader(file, name, limits)
    found = _Reader()
    for record in reader:
        found.take(record)
    return found.end(is_cut=reader.is_cut)


class _Reader:
    def __init__(self) -> None:
        self._facts = Facts()
        self._kinds: dict[int, str] = {}
        self._channels: dict[int, str] = {}
        self._places = Places()
        self._tree: dict[str, Any] = {}
        self._root = 0
        self._status: dict[int, int] = {}
        self._has_fault = False

    def take(self, record: object) -> None:
        match record:
            case Schema():
                self._kinds[record.id] = record.name
            case Channel():
                kind = self._kinds.get(record.schema_id, "")
                if kind in _READ:
                    self._channels[record.id] = kind
            case Message():
                self._message(record)
            case Attachment(name="tree_1.xml") if len(record.data) <= LARGEST_XML_BYTES:
                self._facts.xml = record.data
            case _:
                pass

    def end(self, *, is_cut: bool) -> Facts:
        facts = self._facts
        facts.is_cut = is_cut
        if self._has_fault:
            facts.result = "error"
        facts.rows = self._rows()
        facts.trail, facts.boxes = self._places.trail(), self._places.boxes()
        return facts

    def _message(self, message: Message) -> None:
        facts = self._facts
        facts.from_ns = min(facts.from_ns, message.log_time) if facts.messages else message.log_time
        facts.to_ns = max(facts.to_ns, message.log_time)
        facts.messages += 1
        kind = self._channels.get(message.channel_id)
        if kind == PICTURE:
            self._picture(message.data)
        elif kind is not None:
            # What is not of its type, or nested too deeply, is not shown; the times count.
            with suppress(CdrError, ValueError, RecursionError):
                self._ours(kind.rpartition("/")[2], decode(kind, message.data))

    def _picture(self, data: bytes) -> None:
        at = data.find(_JPEG, 0, 1024)
        if at >= 0 and len(data) - at <= LARGEST_PICTURE_BYTES:
            self._facts.picture = data[at:]

    def _ours(self, name: str, fields: Mapping[str, Any]) -> None:
        match name:
            case "Tree":
                self._take_tree(fields)
            case "Tick":
                self._tick(fields)
            case "Fault":
                self._has_fault = True
            case "Scene":
                self._places.scene(fields["data"])
            case "Poses":
                self._places.poses(fields["data"])
            case _:
                pass

    def _take_tree(self, fields: Mapping[str, Any]) -> None:
        """Takes a tree; each segment begins with it, and only another generation is another tree."""
        if not self._tree or fields["generation"] != self._tree["generation"]:
            roots = [uid for uid, up in zip(fields["uid"], fields["parent"], strict=True) if not up]
            self._root = roots[0] if roots else 0
            self._status = {}
        self._tree = dict(fields)

    def _tick(self, fields: Mapping[str, Any]) -> None:
        self._facts.ticks += 1
        changed = dict(zip(fields["changed_uid"], fields["changed_status"], strict=True))
        flashed = dict(zip(fields["flashed_uid"], fields["flashed_status"], strict=True))
        # A result that did not stay until the end of the tick is the one that counts.
        for statuses in (changed, flashed):
            for uid, status in statuses.items():
                if status or uid not in self._status:
                    self._status[uid] = status
        self._facts.result = _RESULTS.get(self._status.get(self._root, 0), self._facts.result)

    def _rows(self) -> list[list[int]]:
        if not self._tree:
            return []
        depths: dict[int, int] = {0: -1}
        rows = []
        for uid, parent in zip(self._tree["uid"], self._tree["parent"], strict=True):
            depths[uid] = depths.get(parent, -1) + 1
            rows.append([depths[uid], self._status.get(uid, 0)])
            if len(rows) == MOST_ROWS:
                break
        return rows
