"""Writes one run of a session, segment by segment."""

from __future__ import annotations

import contextlib
from dataclasses import replace
from typing import TYPE_CHECKING, Any, BinaryIO, Final

from executor.recorder.cdr import encode
from executor.recorder.definitions import OURS
from executor.recorder.moment import SEGMENT_NS, Moment
from executor.recorder.project_files import PROJECT
from executor.recorder.shelf import PICTURE, Segment, file_of
from executor.recorder.writer import RecordingWriter
from executor.stream.scene_parts import without_parts

if TYPE_CHECKING:
    from collections.abc import Mapping

    from executor.recorder.shelf import Shelf

__all__ = ["LATEST_NS", "RunWriter"]

LATEST_NS: Final = 10**7 * 1_000_000_000
MOST_CHANNELS: Final = 500
FILE_TYPE: Final = "application/octet-stream"


class RunWriter:
    """The open segment of a run; the shelf gets the ended ones.

    Args:
        shelf: holds the segments.
        run: the name of the run.
        about: the metadata of the recording, as texts by name.
        files: the project's files; each segment has them.
    """

    def __init__(self, shelf: Shelf, run: str, about: Mapping[str, str], files: Mapping[str, bytes]) -> None:
        self._shelf = shelf
        self.run = run
        self.about = dict(about)
        self.files = dict(files)
        self.moment = Moment()
        self._file: BinaryIO | None = None
        self._writer: RecordingWriter | None = None
        self._open = Segment(run, shelf.next_number(run))
        self._channels: set[tuple[str, str]] = set()
        self._now_ns = 0

    @property
    def now_ns(self) -> int:
        """The time of the last message."""
        return self._now_ns

    @property
    def open_segment(self) -> Segment:
        """The segment that is being written; its file holds `bytes` that are whole."""
        return self._open

    def write(self, topic: str, kind: str, t_ns: int, data: bytes) -> None:
        """Writes a message of a type, as CDR.

        Raises:
            DefinitionError: the definition of the type does not exist.
            ValueError: the run has too many topics, or the time is not one of a run.
            OSError: the disk is full.
        """
        if not 0 <= t_ns <= LATEST_NS:
            raise ValueError(f"{t_ns} ns is not a time of a run")
        if (topic, kind) not in self._channels:
            if len(self._channels) >= MOST_CHANNELS:
                raise ValueError(f"a run has at most {MOST_CHANNELS} topics")
            self._channels.add((topic, kind))
        self._writer_at(t_ns).write(topic, kind, t_ns, data)
        if kind == PICTURE:
            self._open = replace(self._open, picture_bytes=self._open.picture_bytes + len(data))

    def record(self, topic: str, name: str, fields: Mapping[str, Any]) -> None:
        """Writes a message of one of our types.

        Raises:
            KeyError, TypeError, ValueError, struct.error: the fields are not those of the type.
            OSError: the disk is full.
        """
        if name == "Scene":
            slim, parts = without_parts(fields["data"])
            if self._shelf.keep_parts(self.run, parts):
                fields = {**fields, "data": slim}
        kind = f"{OURS}/msg/{name}"
        data = encode(kind, fields)
        self.write(topic, kind, fields["stamp"], data)
        self.moment.take(name, fields)

    def change_files(self, files: Mapping[str, bytes]) -> None:
        """Attaches the files that differ from those before, and gives all of them to the next segments.

        Raises:
            OSError: the disk is full.
        """
        own = {name: data for name, data in self.files.items() if not name.startswith(PROJECT)}
        before, self.files = self.files, {**files, **own}
        changed = [name for name in sorted(files) if before.get(name) != files[name]]
        if self._writer is not None and changed:
            self._writer.flush()  # what the open chunk holds precedes them
            for name in changed:
                self._writer.attach(name, FILE_TYPE, files[name])

    def flush(self) -> None:
        """Flushes all written messages, and reports the length of the open segment.

        Raises:
            OSError: the disk is full.
        """
        if self._writer is None or self._file is None:
            return
        self._writer.flush()
        size = self._file.tell()
        if size != self._open.bytes:
            self._open = replace(self._open, to_ns=self._writer.last_ns, bytes=size)
            self._shelf.announce(self._open)

    def end(self) -> None:
        """Completes the open segment.

        Raises:
            OSError: the disk is full; everything written before remains readable.
        """
        if self._writer is None or self._file is None:
            return
        with self._file as file:
            self._writer.finish()
            size = file.tell()
        ended = replace(
            self._open,
            to_ns=self._writer.last_ns,
            bytes=size,
            is_complete=True,
            picture_bytes=min(self._open.picture_bytes, size),
        )
        self._writer, self._file = None, None
        self._open = Segment(self.run, ended.number + 1)
        self._shelf.add(ended)

    def abandon(self) -> None:
        """Closes the file without its end, after an error of the disk; flushed data remain readable."""
        if self._file is not None:
            file, self._file, self._writer = self._file, None, None
            if self._open.bytes:
                self._shelf.segments.append(self._open)
            with contextlib.suppress(OSError):
                file.close()

    def _writer_at(self, t_ns: int) -> RecordingWriter:
        """Returns the writer for a message at a time: of another segment after 20 s."""
        self._now_ns = max(self._now_ns, t_ns)
        if self._writer is not None and self._now_ns - self._open.from_ns >= SEGMENT_NS:
            self.end()
        return self._writer or self._begin_segment(self._now_ns)

    def _begin_segment(self, t_ns: int) -> RecordingWriter:
        path = file_of(self._shelf.folder, self._open)
        path.parent.mkdir(exist_ok=True)
        self._file = path.open("wb")
        self._writer = writer = RecordingWriter(self._file, self.about)
        self._open = replace(self._open, from_ns=t_ns, to_ns=t_ns)
        for name, data in sorted(self.files.items()):
            writer.attach(name, FILE_TYPE, data)
        for topic, name, fields in self.moment.head(t_ns):
            writer.record(topic, name, fields)
        return writer
