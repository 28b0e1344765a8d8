"""Writes messages as CDR, the encoding of ROS 2, and reads ours.

Little-endian; each number is aligned to its size. ROS's own serializer leaves garbage between and behind the
values, so that equal messages differ; here the gaps are 0. A message is a mapping of its fields, or an object
of a ROS class. A `builtin_interfaces/Time` of ours is a time in ns.
"""

from __future__ import annotations

import array
import functools
import itertools
import struct
import sys
from operator import attrgetter, itemgetter
from typing import TYPE_CHECKING, Any, Final

from executor.recorder.definitions import PRIMITIVES, fields_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from executor.recorder.definitions import Field

    Put = Callable[[bytearray, Any], None]
    Take = Callable[[Any], Sequence[Any]]
    _Step = Callable[[bytearray, Sequence[Any]], None]

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
_LARGEST: Final = 8
"""The size of the largest number, at which all numbers are aligned."""
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
    take, steps = _mapping_steps(name)
    data = bytearray()
    _put_all(steps, data, take(message))
    return HEADER + data


def encode_object(name: str, message: Any) -> bytes:
    """Returns a message of a ROS class as CDR.

    Raises:
        DefinitionError: the definition of the type is not there.
    """
    data = bytearray()
    _object_writer(name)(data, message)
    return HEADER + data


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


class _Run:
    """Puts neighbouring numbers at once: one packed form for each place at which the first may be."""

    def __init__(self, start: int, codes: Sequence[str]) -> None:
        self._part = slice(start, start + len(codes))
        self._pack = [struct.Struct(_padded(codes, at)).pack for at in range(_LARGEST)]

    def __call__(self, data: bytearray, values: Sequence[Any]) -> None:
        data += self._pack[len(data) % _LARGEST](*values[self._part])


class _One:
    """Puts one value that is not a number."""

    def __init__(self, place: int, put: Put) -> None:
        self._place = place
        self._put = put

    def __call__(self, data: bytearray, values: Sequence[Any]) -> None:
        self._put(data, values[self._place])


def _padded(codes: Sequence[str], at: int) -> str:
    """Returns the form of numbers that begin at a place, with the gaps that align each."""
    form = "<"
    for code in codes:
        size = struct.calcsize(f"<{code}")
        gap = -at % size
        form += "x" * gap + code
        at += gap + size
    return form


def _put_all(steps: Sequence[_Step], data: bytearray, values: Sequence[Any]) -> None:
    for step in steps:
        step(data, values)


def _steps(fields: Sequence[Field]) -> tuple[_Step, ...]:
    """Returns the functions that put the values of fields, in their order."""
    steps: list[_Step] = []
    for is_number, group in itertools.groupby(enumerate(fields), lambda each: _is_number(each[1])):
        members = list(group)
        if is_number:
            steps.append(_Run(members[0][0], [_SIZES[field.kind][0] for _, field in members]))
        else:
            steps += [_One(place, _writer(field)) for place, field in members]
    return tuple(steps)


def _is_number(field: Field) -> bool:
    return field.kind in _SIZES and not field.is_list


@functools.cache
def _mapping_steps(name: str) -> tuple[Take, tuple[_Step, ...]]:
    fields = fields_of(name)
    return _getter(itemgetter(*(field.name for field in fields)), len(fields)), _steps(fields)


@functools.cache
def _object_writer(name: str) -> Put:
    """Returns the function that writes the fields of an object, in their order, with those of its parts."""
    leaves = list(_leaves(name))
    if not leaves:
        return lambda data, value: None
    take = _getter(attrgetter(*(field.name for field in leaves)), len(leaves))
    steps = _steps(leaves)

    def put(data: bytearray, value: Any) -> None:
        _put_all(steps, data, take(value))

    return put


def _getter(get: Take, count: int) -> Take:
    """Returns a function that takes values as a tuple, also a single one."""
    return get if count > 1 else lambda message: (get(message),)


def _leaves(name: str, prefix: str = "") -> Iterator[Field]:
    """Yields the fields of a type, and in the place of a part the part's own, by their dotted names."""
    for field in fields_of(name):
        dotted = f"{prefix}{field.name}"
        if field.is_list or field.kind in PRIMITIVES:
            yield field._replace(name=dotted)
        else:
            yield from _leaves(field.kind, f"{dotted}.")


def _writer(field: Field) -> Put:
    if field.kind == _TIME and not field.is_list:
        return _put_time
    if field.kind not in _SIZES:
        one = _put_text if field.kind == "string" else _object_writer(field.kind)
        return functools.partial(_put_items, one, field.length) if field.is_list else one
    code, size = _SIZES[field.kind]
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
