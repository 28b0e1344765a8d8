"""Reads the times of a recording from the statistics at its end, without reading the rest. Pure.

The bytes come from an untrusted process: each number is checked before it is used. The layout is that of
MCAP (mcap.dev/spec): summary, footer, magic.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["DamagedError", "length_of"]

MAGIC: Final = b"\x89MCAP0\r\n"
MOST_SUMMARY_BYTES: Final = 16 << 20
LONGEST_S: Final = 1e7
_FOOTER: Final = struct.Struct("<BQQQI")
_RECORD: Final = struct.Struct("<BQ")
_STATISTICS: Final = struct.Struct("<QHIIIIQQ")
_FOOTER_CODE: Final = 0x02
_STATISTICS_CODE: Final = 0x0B


class DamagedError(ValueError):
    """The bytes are no complete recording."""


def length_of(read: Callable[[int, int], bytes], size: int) -> tuple[float, float]:
    """Returns the simulated time of the first message, and the time from it to the last, in s.

    Args:
        read: returns the bytes at an offset, of a length.
        size: the size of the recording in bytes.

    Raises:
        DamagedError: it is not a complete MCAP file, or has no messages.
    """
    tail = _FOOTER.size + len(MAGIC)
    if size < len(MAGIC) + tail or read(0, len(MAGIC)) != MAGIC:
        raise DamagedError("it does not begin as an MCAP file")
    end = read(size - tail, tail)
    code, length, summary_at, _, _ = _FOOTER.unpack_from(end)
    if end[_FOOTER.size :] != MAGIC or code != _FOOTER_CODE or length != _FOOTER.size - _RECORD.size:
        raise DamagedError("it has no end")
    room = size - tail - summary_at
    if not len(MAGIC) <= summary_at or not 0 < room <= MOST_SUMMARY_BYTES:
        raise DamagedError("it has no summary")
    for code, record in _records(read(summary_at, room)):
        if code == _STATISTICS_CODE:
            return _span_s(record)
    raise DamagedError("its summary has no statistics")


def _records(data: bytes) -> Iterator[tuple[int, bytes]]:
    at = 0
    while at + _RECORD.size <= len(data):
        code, length = _RECORD.unpack_from(data, at)
        at += _RECORD.size
        if length > len(data) - at:
            raise DamagedError("a record is longer than the summary")
        yield code, data[at : at + length]
        at += length


def _span_s(record: bytes) -> tuple[float, float]:
    if len(record) < _STATISTICS.size:
        raise DamagedError("its statistics are too short")
    count, *_, start_ns, end_ns = _STATISTICS.unpack_from(record)
    start_s, span_s = float(start_ns) * 1e-9, float(end_ns - start_ns) * 1e-9
    if not count or not 0 <= span_s <= LONGEST_S or start_s > LONGEST_S:
        raise DamagedError("it has no messages, or times that cannot be")
    return start_s, span_s
