"""The framing of the Debug Adapter Protocol: a header with the length, then JSON."""

from __future__ import annotations

from typing import IO, Final

__all__ = ["MOST_BYTES", "FramingError", "framed", "read_framed"]

MOST_BYTES: Final = 16 << 20
_LENGTH: Final = b"content-length:"
_LONGEST_LINE: Final = 1000


class FramingError(Exception):
    """The bytes are not a message of the protocol."""


def framed(text: bytes) -> bytes:
    """Returns a message with its header."""
    return b"Content-Length: %d\r\n\r\n" % len(text) + text


def read_framed(source: IO[bytes]) -> bytes | None:
    """Returns the next message; None at the end of the source.

    Raises:
        FramingError: the header is wrong, or the message is cut off or too long.
    """
    length = -1
    while (line := source.readline(_LONGEST_LINE)).strip():
        if line.lower().startswith(_LENGTH):
            number = line[len(_LENGTH) :].strip()
            length = int(number) if number.isdigit() else -1
    if not line:
        return None
    if not 0 <= length <= MOST_BYTES:
        raise FramingError(f"a message needs a length of 0 to {MOST_BYTES} bytes")
    text = source.read(length)
    if len(text) < length:
        raise FramingError(f"a message of {length} bytes is cut off")
    return text
