"""Writes a recording in which any moment can be read without all that precedes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, BinaryIO, Final

from executor.recorder.moment import SEGMENT_NS, Moment
from executor.recorder.writer import RecordingWriter

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["SeekableWriter"]

LEAST_BYTES: Final = 2 << 20


class SeekableWriter(RecordingWriter):
    """A recording whose whole state is written again from time to time, as each segment of a session begins.

    That happens after 20 s and 2 MiB, whichever is later, so that a short file does not grow by it. Sizes are
    those before packing, so two recordings of one run have it at the same places.
    """

    def __init__(self, file: BinaryIO, about: Mapping[str, str]) -> None:
        super().__init__(file, about)
        self._moment = Moment()
        self._due_ns = SEGMENT_NS
        self._bytes = 0

    def write(self, topic: str, kind: str, t_ns: int, data: bytes) -> None:
        """As `RecordingWriter.write`."""
        super().write(topic, kind, t_ns, data)
        self._bytes += len(data)

    def record(self, topic: str, name: str, fields: Mapping[str, Any]) -> None:
        """As `RecordingWriter.record`, with the state before the message where it is due."""
        stamp = fields["stamp"]
        if stamp >= self._due_ns and self._bytes >= LEAST_BYTES:
            self._due_ns, self._bytes = stamp + SEGMENT_NS, 0
            # The state begins a chunk: readers fetch whole ones.
            self.flush()
            for each in self._moment.head(stamp):
                super().record(*each)
        super().record(topic, name, fields)
        self._moment.take(name, fields)
