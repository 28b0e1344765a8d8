"""Converts a recording of older versions, line by line as JSON, to MCAP."""

from __future__ import annotations

import base64
import binascii
import gzip
import zlib
from typing import TYPE_CHECKING, Any, BinaryIO, Final

import msgspec

from executor.recorder.events import EventRecorder
from executor.recorder.reader import RecordingError
from executor.recorder.writer import RecordingWriter

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

__all__ = ["FORMAT", "convert_lines"]

FORMAT: Final = "bt-studio/recording"
LINE_BYTES: Final = 64 << 20
TOTAL_BYTES: Final = 2 << 30
_HINT: Final = "Is it a file that `bt-studio run --record F.jsonl` wrote?"
_encode = msgspec.msgpack.Encoder().encode


def convert_lines(source: Path, out: BinaryIO) -> int:
    """Writes a recording of lines as MCAP; returns the number of messages. A last line may be cut off.

    Raises:
        RecordingError: a line is not of such a recording; the error has its number.
        OSError: a file cannot be read or written.
    """
    lines = _lines(source)
    number, first = next(lines, (1, b""))
    head = _object(source, number, first)
    if head.get("format") != FORMAT or head.get("version") != 1:
        raise RecordingError(source.name, 1, "it does not begin as a recording of version 1", _HINT)
    about = {name: str(value) for name, value in head.items() if name not in {"format", "version"}}
    writer = RecordingWriter(out, about)
    recorder = EventRecorder(writer)
    waiting: tuple[int, bytes] | None = None
    for number, text in lines:
        if waiting is not None:
            _take(recorder, _object(source, *waiting), source, waiting[0])
        waiting = (number, text)
    if waiting is not None and waiting[1].endswith(b"\n"):
        _take(recorder, _object(source, *waiting), source, waiting[0])
    writer.finish()
    return writer.messages


def _lines(source: Path) -> Iterator[tuple[int, bytes]]:
    opened = gzip.open if source.suffix == ".gz" else open
    number, total = 0, 0
    with opened(source, "rb") as file:
        while True:
            try:
                line = file.readline(LINE_BYTES + 1)
            except (EOFError, zlib.error, gzip.BadGzipFile) as error:
                if number and isinstance(error, EOFError):
                    return  # cut off
                raise RecordingError(source.name, number + 1, "it cannot be unpacked", _HINT) from error
            number, total = number + 1, total + len(line)
            if len(line) > LINE_BYTES or total > TOTAL_BYTES:
                raise RecordingError(source.name, number, "it is too large", f"At most {TOTAL_BYTES} bytes.")
            if not line:
                return
            yield number, line


def _object(source: Path, number: int, line: bytes) -> dict[str, Any]:
    try:
        return msgspec.json.decode(line, type=dict[str, Any])
    except (msgspec.DecodeError, RecursionError) as error:
        raise RecordingError(source.name, number, "the line is no JSON object", _HINT) from error


def _take(recorder: EventRecorder, line: dict[str, Any], source: Path, number: int) -> None:
    try:
        match line.get("type"):
            case "event":
                recorder.event(line["command"], line["t"], line.get("tick") or 0, line["data"])
            case "scene" | "poses" as stream:
                recorder.frame(stream, line["t"], _encode(_with_bytes(line, stream)))
            case "scan":
                recorder.scan(line | {"ranges": base64.b64decode(line["ranges"])})
            case _:
                pass  # pictures of the stream are no pictures of a camera's topic
    except (KeyError, TypeError, ValueError, AttributeError, binascii.Error, OverflowError) as error:
        text = f"the line is not what its type says ({type(error).__name__})"
        raise RecordingError(source.name, number, text, _HINT) from error


def _with_bytes(line: dict[str, Any], stream: str) -> dict[str, Any]:
    """Returns a frame with the bytes that JSON holds as base64."""
    if stream == "poses":
        return line | {name: base64.b64decode(line[name]) for name in ("ids", "poses")}
    coded = ("positions", "normals", "indices", "uvs")
    meshes = {
        key: {name: base64.b64decode(value) if name in coded else value for name, value in mesh.items()}
        for key, mesh in line["meshes"].items()
    }
    textures = {
        key: texture | {"jpeg": base64.b64decode(texture["jpeg"])}
        for key, texture in (line.get("textures") or {}).items()
    }
    return line | {"meshes": meshes} | ({"textures": textures} if textures else {})
