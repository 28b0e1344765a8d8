"""Writes and reads our messages as CDR, the encoding of ROS 2.

Little-endian; each number is aligned to its size.
A message is a mapping of its fields. Only what `executor/recorder/msg` uses is known here: numbers, texts,
`builtin_interfaces/Time`, and lists of numbers and texts. Messages of ROS come as CDR already.
"""

from __future__ import annotations

import array
import functools
import struct
import sys
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.definitions import fields_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

__all__ = ["CdrError", "decode", "encode", "stamp_of"]

HEADER: Final = b"\x00\x01\x00\x00"
MOST_ITEMS: Final = 64 << 20
_SIZES: Final = {"bool": ("B", 1), "uint8": ("B", 1), "int32": ("i", 4), "uint32": ("I", 4)} | {
    "uint64": ("Q", 8),
    "float32": ("f", 4),
}
_TIME: Final = "builtin_interfaces/Time"


class CdrError(ValueError):
    """Bytes are not a message of their type."""


def stamp_of(t_ns: int) -> tuple[int, int]:
    """Returns a time in ns as the two numbers of `builtin_interfaces/Time`."""
    return divmod(t_ns, 1_000_000_000)


def encode(name: str, message: Mapping[str, Any]) -> bytes:
    """Returns a message of one of our types as CDR; a `stamp` is a time in ns.

    Raises:
        KeyError: a field is missing.
    """
    data = bytearray()
    for field, put in _writers(name):
        put(data, message[field])
    return HEADER + bytes(data)


def decode(name: str, data: bytes) -> dict[str, Any]:
    """Returns the fields of a message of one of our types.

    Raises:
        CdrError: the bytes are incomplete, or not such a message.
    """
    reader = _Reader(data[4:])
    try:
        if data[:4] != HEADER:
            raise CdrError("the message does not begin as little-endian CDR")
        return {field.name: reader.take(field.kind, is_list=field.is_list) for field in fields_of(name)}
    except (struct.error, ValueError) as error:  # also CdrError
        raise CdrError(f"{name}: {error}") from error


@functools.cache
def _writers(name: str) -> tuple[tuple[str, Callable[[bytearray, Any], None]], ...]:
    return tuple((field.name, _writer(field.kind, is_list=field.is_list)) for field in fields_of(name))


def _writer(kind: str, *, is_list: bool) -> Callable[[bytearray, Any], None]:
    if kind == _TIME:
        return _put_time
    if kind == "string":
        return _put_texts if is_list else _put_text
    code, size = _SIZES[kind]
    if kind == "uint8" and is_list:
        return _put_bytes
    return functools.partial(_put_numbers if is_list else _put_number, struct.Struct(f"<{code}"), code, size)


def _align(data: bytearray, size: int) -> None:
    data.extend(bytes(-len(data) % size))


def _put_time(data: bytearray, t_ns: int) -> None:
    _align(data, 4)
    data.extend(struct.pack("<iI", *stamp_of(t_ns)))


def _put_text(data: bytearray, text: str) -> None:
    coded = text.encode("utf-8", "replace")
    _align(data, 4)
    data.extend(struct.pack("<I", len(coded) + 1))
    data.extend(coded)
    data.append(0)


def _put_texts(data: bytearray, texts: Sequence[str]) -> None:
    _align(data, 4)
    data.extend(struct.pack("<I", len(texts)))
    for text in texts:
        _put_text(data, text)


def _put_bytes(data: bytearray, values: bytes) -> None:
    _align(data, 4)
    data.extend(struct.pack("<I", len(values)))
    data.extend(bytes(values))


def _put_number(form: struct.Struct, _code: str, size: int, data: bytearray, value: float) -> None:
    _align(data, size)
    data.extend(form.pack(value))


def _put_numbers(_form: struct.Struct, code: str, size: int, data: bytearray, values: Sequence[int]) -> None:
    _align(data, 4)
    data.extend(struct.pack("<I", len(values)))
    if values:
        _align(data, size)
        packed = array.array(code, values)
        if sys.byteorder == "big":
            packed.byteswap()
        data.extend(packed.tobytes())


class _Reader:
    def __init__(self, data: bytes) -> None:
        self._data = data
        self._at = 0

    def take(self, kind: str, *, is_list: bool) -> Any:
        if kind == _TIME:
            seconds, nanoseconds = self._number("i", 4), self._number("I", 4)
            return seconds * 1_000_000_000 + nanoseconds
        if not is_list:
            return self._one(kind)
        count = self._number("I", 4)
        if count > min(MOST_ITEMS, len(self._data)):
            raise CdrError(f"a list of {count} items in a message of {len(self._data)} bytes")
        if kind == "uint8":
            return self._bytes(count)
        return [self._one(kind) for _ in range(count)]

    def _one(self, kind: str) -> Any:
        if kind == "string":
            return self._bytes(self._number("I", 4))[:-1].decode()
        value = self._number(*_SIZES[kind])
        return bool(value) if kind == "bool" else value

    def _number(self, code: str, size: int) -> Any:
        self._at += -self._at % size
        (value,) = struct.unpack_from(f"<{code}", self._data, self._at)
        self._at += size
        return value

    def _bytes(self, count: int) -> bytes:
        end = self._at + count
        if end > len(self._data):
            raise CdrError(f"{count} bytes are announced where {len(self._data) - self._at} are left")
        taken = self._data[self._at : end]
        self._at = end
        return taken
