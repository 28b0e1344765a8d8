"""Finds the format of a foreign file, and writes it as a recording."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, Final

from mcap.records import Header

from executor.recorder.outside import bags, btlog, btsqlite, tables
from executor.recorder.outside.limits import Counter
from executor.recorder.reader import MAGIC, Limits, RecordReader
from executor.recorder.recover import recover
from executor.recorder.seekable import SeekableWriter
from executor.recorder.writer import LIBRARY

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.recorder.writer import RecordingWriter

__all__ = ["Converted", "convert_outside"]

_PACKED: Final = {b"\x1f\x8b": "gzip", b"PK": "a zip", b"\x28\xb5\x2f\xfd": "zstd"}
_KNOWN: Final = "Known are MCAP, bags of ROS 2, and the .btlog and SQLite logs of BehaviorTree.CPP."


@dataclass(frozen=True)
class Converted:
    """The result.

    Attributes:
        messages: the number of messages.
        lost_bytes: the bytes at the end that were not whole.
        late: the messages that were not in the order of time, and were sorted.
    """

    messages: int
    lost_bytes: int = 0
    late: int = 0


def convert_outside(source: Path, out: BinaryIO, limits: Limits | None = None, name: str = "") -> Converted:
    """Writes a file, or a folder of a bag, as a recording.

    Args:
        source: the file or folder.
        out: the recording.
        limits: the largest permitted sizes and counts.
        name: its name in errors; by default that of the path.

    Raises:
        RecordingError: it is no log that can be read, or hostile; mostly an `OutsideError`.
        OSError: a file cannot be read or written.
    """
    counter = Counter(name or source.name, limits or Limits())
    place = getattr(out, "name", None)
    folder = Path(place).parent if isinstance(place, str) else None
    if source.is_dir():
        files = bags.files_of_bag(source)
        if not files or len(files) > bags.MOST_FILES:
            text = "it has no .mcap or .db3 file" if not files else "it has too many files"
            is_packed = not files and bags.packed_otherwise(source)
            hint = "Its files are packed: unpack them first (zstd is read)." if is_packed else _KNOWN
            raise counter.error("not_a_log", 0, text, hint)
        return _written(out, lambda writer: bags.convert_bag(files, counter, writer, folder))
    with source.open("rb") as file:
        begin = file.read(64)
        file.seek(0)
        if begin.startswith(btlog.BEGIN):
            return _written(out, lambda writer: btlog.convert_btlog(file, counter, writer))
        if begin.startswith(MAGIC):
            if _is_ours(file, counter):
                file.seek(0)
                found = recover(file, counter.name, out, counter.limits)
                return Converted(found.messages, found.lost_bytes)
            return _written(out, lambda writer: bags.convert_bag([source], counter, writer, folder))
    if begin.startswith(tables.BEGIN):
        return _of_tables(source, counter, out, folder)
    for mark, kind in _PACKED.items():
        if begin.startswith(mark):
            raise counter.error("not_a_log", 0, f"it is packed by {kind}", "Unpack it first.")
    raise counter.error("not_a_log", 0, "it is no log of a known kind", _KNOWN)


def _written(out: BinaryIO, write: Callable[[RecordingWriter], int | None]) -> Converted:
    writer = SeekableWriter(out, {})
    late = write(writer) or 0
    writer.finish()
    return Converted(writer.messages, late=late)


def _is_ours(file: BinaryIO, counter: Counter) -> bool:
    """Returns whether a file was written by BT Studio, so that it is copied with all its topics."""
    for record in RecordReader(file, counter.name, counter.limits):
        return isinstance(record, Header) and record.library == LIBRARY
    return False


def _of_tables(source: Path, counter: Counter, out: BinaryIO, folder: Path | None) -> Converted:
    with tables.Tables(source, counter, {**btsqlite.TABLES, **bags.TABLES}) as opened:
        names = opened.names()
    if names >= set(btsqlite.TABLES):
        return _written(out, lambda writer: btsqlite.convert_btsqlite(source, counter, writer))
    if names >= set(bags.TABLES):
        return _written(out, lambda writer: bags.convert_bag([source], counter, writer, folder))
    raise counter.error("not_a_log", 0, "it has no tables of a known kind", _KNOWN)
