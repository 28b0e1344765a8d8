"""Writes one MCAP file of the profile `ros2`, with chunks of 256 KiB packed by zstd.

Log time is simulated and never decreases; messages that are written while time is paused have the same time
and a rising sequence number. `flush` makes everything written so far readable, also if the process is killed
afterwards.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, BinaryIO, Final

from mcap.writer import CompressionType, Writer

from executor.recorder.cdr import encode
from executor.recorder.definitions import OURS, full_text
from executor.stream.scene_parts import PREFIX, without_parts

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

__all__ = ["CHUNK_BYTES", "FORMAT_VERSION", "LIBRARY", "PART_TYPE", "RecordingWriter", "nanoseconds"]

CHUNK_BYTES: Final = 256 * 1024
LIBRARY: Final = "bt-studio"
"""The name of the writer in the head of each file."""
PART_TYPE: Final = "application/vnd.msgpack"
"""The type of attachments with meshes and textures."""
FORMAT_VERSION: Final = 3
"""The version of our types. A reader of this version reads all lower ones."""
_SEQUENCES: Final = 1 << 32


def nanoseconds(t_s: float) -> int:
    """Returns simulated seconds as nanoseconds."""
    return max(0, round(t_s * 1e9))


class RecordingWriter:
    """An MCAP file that is open for writing.

    Args:
        file: the file; it is not closed by `finish`.
        about: the metadata: project, revision, seed, versions, platform.
    """

    def __init__(self, file: BinaryIO, about: Mapping[str, str]) -> None:
        self._file = file
        self._writer = Writer(file, chunk_size=CHUNK_BYTES, compression=CompressionType.ZSTD)
        self._writer.start(profile="ros2", library=LIBRARY)
        self._writer.add_metadata("bt-studio", {"format_version": str(FORMAT_VERSION), **about})
        self._parts: set[str] = set()
        self._schemas: dict[str, int] = {}
        self._channels: dict[tuple[str, str], int] = {}
        self._last_ns = 0
        self._sequence = 0
        self.messages = 0
        file.flush()

    @property
    def last_ns(self) -> int:
        """The time of the last message."""
        return self._last_ns

    def write(self, topic: str, kind: str, t_ns: int, data: bytes) -> None:
        """Writes a message of a type (`sensor_msgs/msg/LaserScan`), as CDR.

        Raises:
            DefinitionError: the definition of the type does not exist.
            OSError: the disk is full.
        """
        channel = self._channels.get((topic, kind)) or self._add_channel(topic, kind)
        self._last_ns = max(self._last_ns, t_ns)
        self._sequence = (self._sequence + 1) % _SEQUENCES
        self.messages += 1
        self._writer.add_message(channel, self._last_ns, data, self._last_ns, self._sequence)

    def record(self, topic: str, name: str, fields: Mapping[str, Any]) -> None:
        """Writes a message of one of our types; its `stamp` is a time in ns."""
        kind = f"{OURS}/msg/{name}"
        self.write(topic, kind, fields["stamp"], encode(kind, fields))

    def scene(self, t_ns: int, frame: bytes) -> None:
        """Writes a frame `scene` of the stream; its meshes and textures are attached, each once."""
        slim, parts = without_parts(frame)
        for digest, data in parts.items():
            if digest not in self._parts:
                self._parts.add(digest)
                self.attach(f"{PREFIX}{digest}", PART_TYPE, data)
        self.record("/world/scene", "Scene", {"stamp": t_ns, "data": slim})

    def attach(self, name: str, media_type: str, data: bytes) -> None:
        """Adds a file to the recording."""
        self._writer.add_attachment(self._last_ns, self._last_ns, name, media_type, data)

    def describe(self, name: str, texts: Mapping[str, str]) -> None:
        """Adds texts by name to the recording."""
        self._writer.add_metadata(name, dict(texts))

    def flush(self) -> None:
        """Ends the open chunk, and hands everything to the operating system."""
        self._writer.flush()  # type: ignore[no-untyped-call]
        self._file.flush()

    def finish(self) -> None:
        """Writes the index; the file is complete then."""
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._file.flush()

    def _add_channel(self, topic: str, kind: str) -> int:
        schema = self._schemas.get(kind)
        if schema is None:
            text = full_text(kind).encode()
            schema = self._schemas[kind] = self._writer.register_schema(kind, "ros2msg", text)
        found = self._channels[topic, kind] = self._writer.register_channel(topic, "cdr", schema, {})
        return found
