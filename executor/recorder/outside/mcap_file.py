"""Reads the messages of an MCAP file from outside: as they lie in it, and chunk by chunk afterwards."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mcap.records import Channel, Message, Schema

from executor.recorder.outside.sorting import Sent
from executor.recorder.reader import RecordReader

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

    from executor.recorder.outside.limits import Counter
    from executor.recorder.reader import Record

__all__ = ["McapFile"]


class McapFile:
    """An MCAP file; the place of its messages is the offset of their chunk, or their own.

    Args:
        path: the file.
        kept: the types of which messages are read; encoded as CDR.
        counter: the limits.
    """

    def __init__(self, path: Path, kept: frozenset[str], counter: Counter) -> None:
        self.path = path
        self.has_one_meaning = True
        """Whether no channel changed its topic or type, so that chunks can be read in any order."""
        self._kept = kept
        self._counter = counter
        self._kinds: dict[int, str] = {}
        self._channels: dict[int, tuple[str, str]] = {}
        self._reader: RecordReader | None = None

    def messages(self) -> Iterator[Sent]:
        """Yields the messages in the order of the file."""
        self._kinds, self._channels = {}, {}
        with self.path.open("rb") as file:
            self._reader = RecordReader(file, self._counter.name, self._counter.limits)
            yield from self._sent(self._reader, self._reader)

    def chunk(self, place: int) -> list[Sent]:
        """Returns the messages at a place, once `messages` was read to its end."""
        if self._reader is None:
            raise RuntimeError("no message was read yet")
        with self.path.open("rb") as file:
            self._reader.file = file
            return list(self._sent(self._reader, self._reader.at(place)))

    def _sent(self, reader: RecordReader, records: Iterable[Record]) -> Iterator[Sent]:
        counter = self._counter
        for number, record in enumerate(records):
            if number % 1000 == 0 and counter.is_late():
                raise counter.late(reader.read_to)
            match record:
                case Schema():
                    self._kinds[record.id] = record.name
                case Channel():
                    self._channel(record)
                case Message() if record.channel_id in self._channels:
                    topic, kind = self._channels[record.channel_id]
                    yield Sent(topic, kind, record.log_time, record.data, reader.read_to)
                case _:
                    pass

    def _channel(self, record: Channel) -> None:
        kind = self._kinds.get(record.schema_id, "")
        if kind in self._kept and record.message_encoding == "cdr":
            told = record.topic, kind
            if self._channels.setdefault(record.id, told) != told:
                self.has_one_meaning = False
                self._channels[record.id] = told
