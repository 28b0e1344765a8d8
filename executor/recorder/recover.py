"""Completes a recording that was cut off: a pass over the records recovers every whole chunk."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, BinaryIO

from mcap.records import Attachment, Channel, Message, Metadata, Schema
from mcap.writer import CompressionType, Writer

from executor.recorder.reader import Limits, RecordReader
from executor.recorder.writer import CHUNK_BYTES, LIBRARY, PART_TYPE
from executor.stream.scene_parts import PREFIX

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

__all__ = ["Recovered", "join", "recover", "thin"]

EMPTY: Mapping[str, bytes] = MappingProxyType({})


@dataclass(frozen=True)
class Recovered:
    """The recovered messages, the time of the last one, and the bytes that could not be used."""

    messages: int
    end_ns: int
    was_cut: bool
    lost_bytes: int


def recover(file: BinaryIO, name: str, out: BinaryIO, limits: Limits | None = None) -> Recovered:
    """Writes a complete file with everything that is whole in another.

    Raises:
        RecordingError: the file is no recording, or hostile.
    """
    reader = RecordReader(file, name, limits or Limits())
    messages, end_ns = _copy([reader], out)
    length = file.seek(0, 2)
    lost = length - reader.read_to if reader.is_cut else 0
    return Recovered(messages, end_ns, reader.is_cut, lost)


def join(
    files: Sequence[tuple[BinaryIO, str]],
    out: BinaryIO,
    limits: Limits | None = None,
    *,
    parts: Mapping[str, bytes] | None = None,
) -> int:
    """Writes segments into one file, in their order; returns the number of messages.

    The file begins with `parts`, the meshes and textures of its scenes by their hash.

    Raises:
        RecordingError: one of them is no recording.
    """
    readers = [RecordReader(file, name, limits or Limits()) for file, name in files]
    return _copy(readers, out, parts=parts or {})[0]


def thin(file: BinaryIO, name: str, out: BinaryIO, keeps: Callable[[str, str, int], bool]) -> None:
    """Writes a file again with only some of its messages.

    Args:
        file: the file, at its begin.
        name: its name in errors.
        out: the file to write.
        keeps: decides by the topic, the type, and the time of a message in ns.

    Raises:
        RecordingError: the file is no recording.
    """
    _copy([RecordReader(file, name, Limits())], out, keeps)


def _copy(
    readers: Sequence[RecordReader],
    out: BinaryIO,
    keeps: Callable[[str, str, int], bool] | None = None,
    parts: Mapping[str, bytes] = EMPTY,
) -> tuple[int, int]:
    writer = Writer(out, chunk_size=CHUNK_BYTES, compression=CompressionType.ZSTD)
    writer.start(profile="ros2", library=LIBRARY)
    for digest, data in parts.items():
        writer.add_attachment(0, 0, f"{PREFIX}{digest}", PART_TYPE, data)
    schemas: dict[tuple[str, bytes], int] = {}
    channels: dict[tuple[str, int], int] = {}
    seen: set[tuple[str, bytes]] = set()
    attached: dict[str, bytes] = {}
    messages, end_ns = 0, 0
    for reader in readers:
        own_schemas: dict[int, int] = {}
        own_channels: dict[int, int] = {}
        kinds: dict[int, str] = {}
        of_channel: dict[int, tuple[str, str]] = {}
        for record in reader:
            match record:
                case Schema():
                    key = record.name, record.data
                    if key not in schemas:
                        schemas[key] = writer.register_schema(record.name, record.encoding, record.data)
                    own_schemas[record.id] = schemas[key]
                    kinds[record.id] = record.name
                case Channel():
                    place = record.topic, own_schemas.get(record.schema_id, 0)
                    if place not in channels:
                        channels[place] = writer.register_channel(
                            record.topic, record.message_encoding, place[1], dict(record.metadata)
                        )
                    own_channels[record.id] = channels[place]
                    of_channel[record.id] = record.topic, kinds.get(record.schema_id, "")
                case Message() if keeps is None or keeps(*of_channel[record.channel_id], record.log_time):
                    messages, end_ns = messages + 1, max(end_ns, record.log_time)
                    # Each segment counts from 1; within one file messages of one time keep their order.
                    sequence = record.sequence if len(readers) == 1 else messages
                    writer.add_message(own_channels[record.channel_id], end_ns, record.data, end_ns, sequence)
                case Attachment() if attached.get(record.name) != record.data:
                    # A file belongs to the trees that follow it, and the open chunk precedes it.
                    writer.flush()  # type: ignore[no-untyped-call]
                    attached[record.name] = record.data
                    writer.add_attachment(
                        record.create_time, record.log_time, record.name, record.media_type, record.data
                    )
                case Metadata() if (text := (record.name, repr(record.metadata).encode())) not in seen:
                    seen.add(text)
                    writer.add_metadata(record.name, record.metadata)
                case _:
                    pass
    writer.finish()  # type: ignore[no-untyped-call]
    return messages, end_ns
