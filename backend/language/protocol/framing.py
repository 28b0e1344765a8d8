"""The framing of the language server protocol: JSON bodies after a `Content-Length` header; does no I/O."""

from __future__ import annotations

from typing import Final

MAX_BODY_BYTES: Final = 16 * 1024 * 1024
_MAX_HEADER_BYTES: Final = 4096
_END: Final = b"\r\n\r\n"


class FramingError(ValueError):
    """The stream violates the protocol; the rest of it cannot be read."""


def framed(body: bytes) -> bytes:
    """Returns a body with its header."""
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


class Unframer:
    """Splits a stream of bytes into bodies."""

    def __init__(self) -> None:
        self._buffer = bytearray()

    def feed(self, data: bytes) -> list[bytes]:
        """Adds received bytes; returns the bodies that are complete.

        Raises:
            FramingError: a header cannot be read, or a body is too large.
        """
        self._buffer += data
        bodies = []
        while (end := self._buffer.find(_END)) >= 0:
            start = end + len(_END)
            length = _length(bytes(self._buffer[:end]))
            if len(self._buffer) < start + length:
                break
            bodies.append(bytes(self._buffer[start : start + length]))
            del self._buffer[: start + length]
        else:
            if len(self._buffer) > _MAX_HEADER_BYTES:
                raise FramingError("a header without an end")
        return bodies


def _length(header: bytes) -> int:
    for line in header.split(b"\r\n"):
        name, _, value = line.partition(b":")
        if name.strip().lower() == b"content-length" and value.strip().isdigit():
            length = int(value)
            if length > MAX_BODY_BYTES:
                raise FramingError(f"a message of {length} bytes")
            return length
    raise FramingError("a header without a length")
