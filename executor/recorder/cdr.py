"""Writes messages as CDR, the encoding of ROS 2, and reads ours.

Little-endian; each number is aligned to its size. ROS's own serializer leaves garbage between and behind the
values, so that equal messages differ; here the gaps are 0. A message is a mapping of its fields, or an object
of a ROS class. A `builtin_interfaces/Time` of ours is a time in ns.
"""

from __future__ import annotations

import array
import functools
import struct
import sys
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.definitions import fields_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from executor.recorder.definitions import Field

    Put = Callable[[bytearray, Any], None]

__all__ = ["CdrError", "decode", "encode", "encode_object", "stamp_of"]

HEADER: Final = b"\x00\x01\x00\x00"
MOST_ITEMS: Final = 64 << 20
_CODES: Final = {"bool": "B", "byte": "B", "char": "B", "uint8": "B", "int8": "b", "int16": "h"} | {
    "uint16": "H",
    "int32": "i",
    "uint32": "I",
    "int64": "q",
    "uint64": "Q",
    "float32": "f",
    "float64": "d",
}
_SIZES: Final = {kind: (code, struct.calcsize(f"<{code}")) for kind, code in _CODES.items()}
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


def encode_object(name: str, message: Any) -> bytes:
    """Returns a message of a ROS class as CDR.

    Raises:
        DefinitionError: the definition of the type is not there.
    """
    data = bytearray()
    _object_writer(name)(data, message)
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
def _writers(name: str) -> tuple[tuple[str, Put], ...]:
    return tuple(
        (field.name, _put_time if field.kind == _TIME else _writer(field)) for field in fields_of(name)
    )


@functools.cache
def _object_writer(name: str) -> Put:
    """Returns the function that writes the fields of an object, in their order."""
    parts = [(attrgetter(field.name), _writer(field)) for field in fields_of(name)]

    def put(data: bytearray, value: Any) -> None:
        for get, put_one in parts:
            put_one(data, get(value))

    return put


def _writer(field: Field) -> Put:
    if field.kind in {"string", "wstring"} or field.kind not in _SIZES:
        one = _put_text if field.kind == "string" else _object_writer(field.kind)
        return functools.partial(_put_items, one, field.length) if field.is_list else one
    code, size = _SIZES[field.kind]
    if not field.is_list:
        return functools.partial(_put_number, struct.Struct(f"<{code}"), size)
    return functools.partial(_put_numbers, code, size, field.length)


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


def _put_items(one: Put, count: int, data: bytearray, values: Sequence[Any]) -> None:
    if not count:
        _align(data, 4)
        data.extend(struct.pack("<I", len(values)))
    for value in values:
        one(data, value)


def _put_number(form: struct.Struct, size: int, data: bytearray, value: float) -> None:
    if size > 1:
        _align(data, size)
    data.extend(form.pack(value))


def _put_numbers(code: str, size: int, count: int, data: bytearray, values: Any) -> None:
    if not count:
        _align(data, 4)
        data.extend(struct.pack("<I", len(values)))
    if len(values):
        _align(data, size)
        data.extend(_packed(code, values))


def _packed(code: str, values: Any) -> bytes:
    """Returns numbers as bytes; bytes, arrays and numpy's arrays of the right type without a loop."""
    if isinstance(values, (bytes, bytearray)):
        return bytes(values)
    if isinstance(values, array.array) and values.typecode == code and sys.byteorder == "little":
        return values.tobytes()
    if hasattr(values, "astype"):
        return bytes(values.astype(f"<{code}").tobytes())
    return struct.pack(f"<{len(values)}{code}", *values)


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
