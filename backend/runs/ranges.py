"""Reads the header `Range`: one range of bytes in a request (RFC 9110, section 14). Pure."""

from __future__ import annotations

import re
from typing import Final

from backend.runs.errors import BadRangeError

__all__ = ["asked_range"]

_RANGE: Final = re.compile(r"bytes=(\d{0,15})-(\d{0,15})")


def asked_range(header: str, size: int) -> tuple[int, int] | None:
    """Returns the first byte and the one after the last; None for all.

    A header that is not understood, such as one with several ranges, means all.

    Raises:
        BadRangeError: the range begins after the end.
    """
    named = _RANGE.fullmatch(header)
    if named is None or not any(named.groups()):
        return None
    first, last = named.groups()
    if not first:
        begin, end = max(0, size - int(last)), size
    else:
        begin, end = int(first), min(size, int(last) + 1) if last else size
        if last and int(last) < begin:
            return None
    if begin >= end:
        raise BadRangeError(size)
    return begin, end
