"""Reads the records of an MCAP file in their order, within bounds, also of a file that was cut off.

Existing readers refuse a file without its end. This one yields all complete records, and reports where it
stopped. Sizes in a file are not trusted: each is compared with a bound before anything is unpacked, and
counted while it is.

    RecordingError    the file is no recording, or hostile; it has a place and a hint
"""

from __future__ import annotations

import io
import struct
import zlib
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, BinaryIO, Final

import lz4.frame
import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Attachment, Channel, Chunk, Header, Message, Metadata, Schema

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Limits", "RecordReader", "RecordingError"]

MAGIC: Final = b"\x89MCAP0\r\n"
DAMAGE: Final = (
    McapError,
    struct.error,
    ValueError,
    EOFError,
    MemoryError,
    RuntimeError,
    OverflowError,
)
_HEAD: Final = struct.Struct("<BQ")
_OURS: Final = "Is it an MCAP file, as `bt-studio run --record` writes them?"
Record = Header | Schema | Channel | Message | Attachment | Metadata


class RecordingError(Exception):
    """The file is not a readable recording."""

    def __init__(self, name: str, offset: int, message: str, hint: str) -> None:
        super().__init__(f"{name}:{offset}: {message} ({hint})")
        self.offset = offset
        self.message = message
        self.hint = hint


@dataclass(frozen=True)
class Limits:
    """The largest sizes and counts that a file may have."""

    chunk_bytes: int = 64 << 20
    total_bytes: int = 2 << 30
    attachment_bytes: int = 64 << 20
    channels: int = 10_000
    messages: int = 10_000_000


@dataclass
class RecordReader:
    """Yields the records of a file.

    Args:
        file: the file, at its begin.
        name: its name in errors.
        limits: the largest permitted sizes and counts.
    """

    file: BinaryIO
    name: str
    limits: Limits = field(default_factory=Limits)
    is_cut: bool = False
    """Whether the end was missing."""
    read_to: int = 0
    """The offset up to which the file is whole."""
    _unpacked: int = 0
    _messages: int = 0
    _channels: set[int] = field(default_factory=set)
    _schemas: set[int] = field(default_factory=set)

    def __iter__(self) -> Iterator[Record]:
        """Yields the records in their order; the messages of chunks in place of the chunks.

        Raises:
            RecordingError: the file is no MCAP file, breaks its rules, or exceeds a limit.
        """
        if self.file.read(len(MAGIC)) != MAGIC:
            raise self._error(0, "it does not begin as an MCAP file", _OURS)
        self.read_to = len(MAGIC)
        while (found := self._next()) is not None:
            opcode, body = found
            yield from self._records(opcode, body)
            self.read_to += _HEAD.size + len(body)

    def at(self, offset: int) -> Iterator[Record]:
        """Yields the record at an offset, or all of its chunk; the limits of counts hold for it alone.

        The file was read to its end before, so that its channels are known.

        Raises:
            RecordingError: as above.
        """
        self._unpacked = self._messages = 0
        self.read_to = self.file.seek(offset)
        if (found := self._next()) is not None:
            yield from self._records(*found)

    def _next(self) -> tuple[int, bytes] | None:
        """Returns the kind and the content of the next record; None at the end."""
        head = self.file.read(_HEAD.size)
        if len(head) < _HEAD.size:
            self.is_cut = True
            return None
        opcode, length = _HEAD.unpack(head)
        if opcode in {Opcode.DATA_END, Opcode.FOOTER}:
            return None
        if length > self.limits.chunk_bytes + self.limits.attachment_bytes:
            raise self._error(self.read_to, f"a record claims {length} bytes", "No record is as large.")
        body = self.file.read(length)
        if len(body) < length:
            self.is_cut = True
            return None
        return opcode, body

    def _records(self, opcode: int, body: bytes) -> Iterator[Record]:
        at = self.read_to
        try:
            if opcode == Opcode.CHUNK:
                yield from self._chunk(Chunk.read(ReadDataStream(io.BytesIO(body))), at)
            else:
                yield from self._one(opcode, body, at)
        except RecordingError:
            raise
        except (*DAMAGE, zstandard.ZstdError) as error:
            text = f"a record cannot be read ({type(error).__name__})"
            raise self._error(at, text, "The file is damaged there.") from error

    def _chunk(self, chunk: Chunk, at: int) -> Iterator[Record]:
        if chunk.uncompressed_size > self.limits.chunk_bytes:
            text = f"a chunk claims {chunk.uncompressed_size} bytes"
            raise self._error(at, text, f"At most {self.limits.chunk_bytes} are read.")
        data = self._unpack(chunk, at)
        self._unpacked += len(data)
        if self._unpacked > self.limits.total_bytes:
            raise self._error(
                at, "the file is too large unpacked", f"At most {self.limits.total_bytes} bytes."
            )
        place = 0
        while place + _HEAD.size <= len(data):
            opcode, length = _HEAD.unpack_from(data, place)
            place += _HEAD.size
            if place + length > len(data):
                raise self._error(at, "a record reaches beyond its chunk", "The file is damaged there.")
            yield from self._one(opcode, data[place : place + length], at)
            place += length

    def _unpack(self, chunk: Chunk, at: int) -> bytes:
        most = chunk.uncompressed_size
        if chunk.compression == "zstd":
            with zstandard.ZstdDecompressor(max_window_size=1 << 27).stream_reader(chunk.data) as stream:
                data = stream.read(most + 1)
        elif chunk.compression == "lz4":
            with lz4.frame.open(io.BytesIO(chunk.data)) as stream:
                data = stream.read(most + 1)
        elif not chunk.compression:
            data = chunk.data
        else:
            raise self._error(
                at, f"a chunk is packed by {chunk.compression[:20]!r}", "zstd and lz4 are known."
            )
        if len(data) != most:
            raise self._error(at, "a chunk is not as long as it claims", "The file is damaged there.")
        if chunk.uncompressed_crc and zlib.crc32(data) != chunk.uncompressed_crc:
            raise self._error(at, "a chunk does not match its checksum", "The file is damaged there.")
        return bytes(data)

    def _one(self, opcode: int, body: bytes, at: int) -> Iterator[Record]:
        stream = ReadDataStream(io.BytesIO(body))
        match opcode:
            case Opcode.MESSAGE:
                yield self._message(Message.read(stream, len(body)), at)
            case Opcode.CHANNEL:
                channel = Channel.read(stream)
                self._channels.add(channel.id)
                self._count(len(self._channels), self.limits.channels, "channels", at)
                if channel.schema_id and channel.schema_id not in self._schemas:
                    raise self._error(at, f"channel {channel.id} has no schema", "The file is damaged there.")
                yield channel
            case Opcode.SCHEMA:
                schema = Schema.read(stream)
                self._schemas.add(schema.id)
                self._count(len(self._schemas), self.limits.channels, "schemas", at)
                yield schema
            case Opcode.HEADER:
                yield Header.read(stream)
            case Opcode.ATTACHMENT:
                yield Attachment.read(stream)
            case Opcode.METADATA:
                yield Metadata.read(stream)
            case 0:
                raise self._error(at, "a record has no kind", "The file is damaged there.")
            case _:
                pass  # indexes, and records that newer writers add

    def _message(self, message: Message, at: int) -> Message:
        self._messages += 1
        self._count(self._messages, self.limits.messages, "messages", at)
        if message.channel_id not in self._channels:
            text = f"a message is of channel {message.channel_id}, which does not exist"
            raise self._error(at, text, "The file is damaged there.")
        return message

    def _count(self, count: int, most: int, what: str, at: int) -> None:
        if count > most:
            raise self._error(at, f"the file has too many {what}", f"At most {most} are read.")

    def _error(self, offset: int, message: str, hint: str) -> RecordingError:
        return RecordingError(self.name, offset, message, hint)
