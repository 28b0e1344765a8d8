"""Writes the events and frames of a run to a file, line by line.

The first line is `{"format": "bt-studio/recording", "version": 1, …}`. An event is `{"type": "event", "t",
"tick", "command", "data"}`, a frame as in the stream protocol with its `type` and `t`; bytes are base64. A
name that ends with `.gz` is compressed. An incomplete recording can still be read.
"""

from __future__ import annotations

import gzip
from typing import TYPE_CHECKING, Any, BinaryIO, Final, Self, cast

import msgspec

from executor import messages
from executor.headless.errors import HeadlessError

if TYPE_CHECKING:
    from pathlib import Path

    from translator import Project

__all__ = ["FORMAT", "VERSION", "Recording", "decode_frame", "open_recording"]

FORMAT: Final = "bt-studio/recording"
VERSION: Final = 1
_LEFT_OUT: Final = frozenset({"ack", "error", "introspection", "snapshot", "progress"})
_KEPT: Final = ("t", "tick", "command", "data")
_encode = msgspec.json.Encoder().encode
decode_frame: Final = msgspec.msgpack.Decoder(
    messages.Scene | messages.Poses | messages.Scan | messages.Camera | messages.View
).decode
"""Decodes a message of the stream socket."""


class Recording:
    """A recording that is open for writing; use it as a context manager, or close it.

    Raises:
        OSError: the file cannot be written.
    """

    def __init__(self, path: Path, about: dict[str, Any]) -> None:
        opened = gzip.open if path.suffix == ".gz" else open
        self._file = cast("BinaryIO", opened(path, "wb"))  # closed by __exit__
        self._write({"format": FORMAT, "version": VERSION, **about})

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Closes the file."""
        self._file.close()

    def event(self, message: dict[str, Any]) -> None:
        """Writes an event of the control socket; replies are left out."""
        if message["command"] not in _LEFT_OUT:
            kept = {name: message[name] for name in _KEPT if name in message}
            self._write({"type": "event"} | kept)

    def frame(self, frame: object) -> None:
        """Writes a frame of the stream socket."""
        self._write(frame)

    def packed_frame(self, data: bytes) -> None:
        """Writes a frame in the encoded form of the stream socket."""
        self.frame(decode_frame(data))

    def _write(self, line: object) -> None:
        self._file.write(_encode(line) + b"\n")


def open_recording(path: Path, project: Project, *, universe: str | None, seed: int) -> Recording:
    """Opens the recording of a run.

    Raises:
        HeadlessError: the file cannot be written.
    """
    about = {"project": project.settings.name, "universe": universe or project.settings.universe}
    try:
        return Recording(path, about | {"seed": seed})
    except OSError as error:
        raise HeadlessError(f"{path}: cannot be written: {error.strerror}") from error
