"""The segments of the runs of a session on disk, within two budgets.

A segment is 20 s of a run and a complete MCAP file by itself. Pictures that are older than a minute are
thinned to two in a second; if there are too many, those of the oldest segments go. Of all else the oldest
segments go once the budget is used up, which holds at least ten minutes of a usual run.
"""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, BinaryIO, Final

from mcap.records import Channel, Message, Schema

from executor.recorder.reader import MAGIC, RecordingError, RecordReader
from executor.recorder.recover import recover, thin

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

__all__ = ["PICTURE", "Budgets", "Segment", "Shelf", "file_of", "files_of", "parts_of"]

PICTURE: Final = "sensor_msgs/msg/CompressedImage"
THIN_AFTER_NS: Final = 60_000_000_000
THINNED_PERIOD_NS: Final = 500_000_000
MOST_READ_BYTES: Final = 1 << 20
PART: Final = ".part"
MOST_PARTS_BYTES: Final = 16 << 20


@dataclass(frozen=True)
class Budgets:
    """The most bytes of pictures, and of all else."""

    pictures: int = 48 << 20
    others: int = 40 << 20


@dataclass(frozen=True)
class Segment:
    """A part of a run: its file may be read up to `bytes`; with 0 it is gone.

    `picture_bytes` of them are pictures; `is_thinned` tells that old pictures were removed.
    """

    run: str
    number: int
    version: int = 0
    from_ns: int = 0
    to_ns: int = 0
    bytes: int = 0
    is_complete: bool = False
    picture_bytes: int = 0
    is_thinned: bool = False


def file_of(folder: Path, segment: Segment) -> Path:
    """Returns the file of a segment."""
    return folder / segment.run / f"{segment.number:05d}.{segment.version}.mcap"


def files_of(folder: Path, run: str) -> list[Path]:
    """Returns the files of a run, in order, each in its newest version; its name has hex digits alone."""
    if not run or not set(run) <= set("0123456789abcdef"):
        return []
    newest: dict[str, Path] = {}
    for path in sorted((folder / run).glob("*.*.mcap"), key=_place):
        newest[path.name.partition(".")[0]] = path
    return list(newest.values())


def parts_of(folder: Path, run: str) -> dict[str, bytes]:
    """Returns the meshes and textures of a run's scenes, by their hash.

    Raises:
        OSError: one of them cannot be read.
    """
    return {path.stem: path.read_bytes() for path in sorted((folder / run).glob(f"*{PART}"))}


def _place(path: Path) -> tuple[int, int]:
    number, version, _ = path.name.split(".")
    return int(number), int(version)


@dataclass
class Shelf:
    """All complete segments, the oldest first.

    Args:
        folder: holds a folder for each run.
        announce: is called with each segment that is new, changed or gone.
        budgets: segments beyond them are removed; with None none is.
    """

    folder: Path
    announce: Callable[[Segment], None]
    budgets: Budgets | None = field(default_factory=Budgets)
    segments: list[Segment] = field(default_factory=list)
    _parts: dict[str, int] = field(default_factory=dict)
    """The bytes of meshes and textures of each run."""

    def recover(self) -> None:
        """Takes over the segments of a killed recorder; a file without its end gets one."""
        for run in sorted(self.folder.iterdir(), key=lambda path: path.stat().st_mtime):
            for path in files_of(self.folder, run.name):
                with contextlib.suppress(OSError, RecordingError):
                    self._parts[run.name] = sum(part.stat().st_size for part in run.glob(f"*{PART}"))
                    self.add(self._recovered(run.name, path))

    def add(self, segment: Segment) -> None:
        """Adds a complete segment, and removes old ones that exceed the budgets."""
        self.segments.append(segment)
        self.announce(segment)
        if self.budgets is not None:
            self._keep_within(segment, self.budgets)

    def keep_parts(self, run: str, parts: Mapping[str, bytes]) -> bool:
        """Keeps meshes and textures of a run beside its segments, each once; returns whether they are kept.

        Raises:
            OSError: the disk is full.
        """
        folder = self.folder / run
        new = {name: data for name, data in parts.items() if not (folder / f"{name}{PART}").exists()}
        size = self._parts.get(run, 0) + sum(map(len, new.values()))
        if size > MOST_PARTS_BYTES:
            return False
        folder.mkdir(exist_ok=True)
        for name, data in new.items():
            fresh = folder / f"{name}.new"
            fresh.write_bytes(data)
            fresh.replace(folder / f"{name}{PART}")
        self._parts[run] = size
        return True

    def drop_run(self, run: str) -> None:
        """Removes all segments of a run."""
        for segment in [one for one in self.segments if one.run == run]:
            self._drop(segment)

    def next_number(self, run: str) -> int:
        """Returns the number of a run's next segment."""
        return max((one.number for one in self.segments if one.run == run), default=-1) + 1

    def read(self, segment: Segment, offset: int, length: int) -> bytes:
        """Returns a part of a segment, at most 1 MiB; of an open segment only flushed data.

        Raises:
            OSError: its file is gone.
        """
        with file_of(self.folder, segment).open("rb") as file:
            file.seek(offset)
            return file.read(max(0, min(length, MOST_READ_BYTES, segment.bytes - offset)))

    def _keep_within(self, newest: Segment, budgets: Budgets) -> None:
        for segment in list(self.segments):
            is_old = segment.run != newest.run or newest.to_ns - segment.to_ns >= THIN_AFTER_NS
            if is_old and segment.picture_bytes and not segment.is_thinned:
                self._rewrite(segment, THINNED_PERIOD_NS)
        while self._pictures() > budgets.pictures:
            self._rewrite(next(one for one in self.segments if one.picture_bytes), 0)
        while self._others() > budgets.others and len(self.segments) > 1:
            self._drop(self.segments[0])

    def _pictures(self) -> int:
        return sum(segment.picture_bytes for segment in self.segments)

    def _others(self) -> int:
        own = sum(segment.bytes - segment.picture_bytes for segment in self.segments)
        return own + sum(self._parts.values())

    def _drop(self, segment: Segment) -> None:
        self.segments.remove(segment)
        file_of(self.folder, segment).unlink(missing_ok=True)
        if not files_of(self.folder, segment.run):  # the open segment of this run may be in it
            with contextlib.suppress(OSError):
                for part in (self.folder / segment.run).glob(f"*{PART}"):
                    part.unlink()
                (self.folder / segment.run).rmdir()
            self._parts.pop(segment.run, None)
        self.announce(replace(segment, bytes=0))

    def _rewrite(self, segment: Segment, period_ns: int) -> None:
        """Writes a segment with fewer pictures; with a period of 0 without any. One that is damaged goes."""
        due: dict[str, int] = {}

        def keeps(topic: str, kind: str, t_ns: int) -> bool:
            if kind != PICTURE:
                return True
            if not period_ns or t_ns < due.get(topic, 0):
                return False
            due[topic] = t_ns + period_ns
            return True

        old, new = file_of(self.folder, segment), replace(segment, version=segment.version + 1)
        path = file_of(self.folder, new)
        try:
            with old.open("rb") as source, path.open("wb") as out:
                thin(source, old.name, out, keeps)
            self._replace(segment, replace(_survey(path, new), is_thinned=True))
        except (OSError, RecordingError):
            path.unlink(missing_ok=True)
            self._drop(segment)
            return
        old.unlink(missing_ok=True)

    def _replace(self, old: Segment, new: Segment) -> None:
        self.segments[self.segments.index(old)] = new
        self.announce(new)

    def _recovered(self, run: str, path: Path) -> Segment:
        number, version = _place(path)
        segment = Segment(run, number, version)
        fixed = file_of(self.folder, replace(segment, version=version + 1))
        with path.open("rb") as source:
            reader = RecordReader(source, path.name)
            for _ in reader:
                pass
            is_whole = not reader.is_cut and _has_end(source)
            if not is_whole:
                source.seek(0)
                try:
                    with fixed.open("wb") as out:
                        recover(source, path.name, out)
                except OSError:  # there is no room for it: it stays as it was cut
                    fixed.unlink(missing_ok=True)
                    return replace(_survey(path, segment), bytes=reader.read_to, is_complete=False)
        if is_whole:
            return _survey(path, segment)
        path.unlink()
        return _survey(fixed, replace(segment, version=version + 1))


def _has_end(file: BinaryIO) -> bool:
    file.seek(-len(MAGIC), 2)
    return file.read() == MAGIC


def _survey(path: Path, segment: Segment) -> Segment:
    """Returns a complete segment with its times and sizes, as they are in its file."""
    pictures, first, last, count = set[int](), None, 0, 0
    kinds: dict[int, str] = {}
    with path.open("rb") as file:
        for record in RecordReader(file, path.name):
            match record:
                case Schema():
                    kinds[record.id] = record.name
                case Channel() if kinds.get(record.schema_id) == PICTURE:
                    pictures.add(record.id)
                case Message():
                    first = record.log_time if first is None else first
                    last = record.log_time
                    count += len(record.data) if record.channel_id in pictures else 0
                case _:
                    pass
    size = path.stat().st_size
    return replace(
        segment,
        from_ns=first or 0,
        to_ns=last,
        bytes=size,
        picture_bytes=min(count, size),
        is_complete=True,
    )
