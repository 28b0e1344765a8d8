"""Messages between the pool and a worker: a length, then msgpack.

Pickle would be unsafe, since a worker that has read users' files cannot be trusted.
"""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, Final

import msgspec

if TYPE_CHECKING:
    import socket

PREFIX: Final = struct.Struct("!Q")
MAX_BYTES: Final = 1 << 30
OUT_OF_MEMORY: Final = 73
"""The exit code of a worker whose job needs more memory than it may use."""


class FrameError(Exception):
    """The other end has closed the connection, or sent an invalid message."""


def pack(message: Any) -> bytes:
    """Returns a message as bytes; equal messages give equal bytes."""
    return msgspec.msgpack.encode(message, order="deterministic")


def send(connection: socket.socket, packed: bytes) -> None:
    """Sends a packed message.

    Raises:
        TimeoutError: the socket timed out.
        FrameError: the other end has closed the connection.
    """
    try:
        connection.sendall(PREFIX.pack(len(packed)))
        connection.sendall(packed)
    except TimeoutError:
        raise
    except OSError as error:
        raise FrameError("the other end is gone") from error


def receive(connection: socket.socket) -> bytearray:
    """Waits for the next message, and returns it in packed form.

    Raises:
        TimeoutError: the socket timed out.
        FrameError: the other end has closed the connection, or sent a message that is too large.
    """
    (length,) = PREFIX.unpack(_exactly(connection, PREFIX.size))
    if length > MAX_BYTES:
        raise FrameError(f"a message of {length} bytes is too large")
    return _exactly(connection, length)


def _exactly(connection: socket.socket, length: int) -> bytearray:
    data = bytearray(length)
    view = memoryview(data)
    while view:
        try:
            count = connection.recv_into(view)
        except TimeoutError:
            raise
        except OSError as error:
            raise FrameError("the other end is gone") from error
        if not count:
            raise FrameError("the other end is gone")
        view = view[count:]
    return data
