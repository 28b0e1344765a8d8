"""The recorder's end of its links: takes the messages of world and application, which it does not trust."""

from __future__ import annotations

import os
import socket
import struct
from typing import TYPE_CHECKING, Final

import msgspec

from executor.recorder.link import MOST_BATCH_BYTES, PREFIX, Mark, Sent

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["MOST_SOURCES", "BrokenSource", "Source", "listen", "take_source"]

MOST_SOURCES: Final = 16
READ_BYTES: Final = 1 << 20
FULL_BYTES: Final = 64 << 10
_CREDENTIALS: Final = struct.Struct("iII")


class BrokenSource(Exception):  # noqa: N818 - says what the source is
    """A source has ended, or sent bytes that are not a message."""


def listen(address: str) -> socket.socket:
    """Listens at an address of the abstract namespace.

    Raises:
        OSError: another process listens there.
    """
    listener = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
    try:
        listener.bind(f"\0{address}")
        listener.listen(MOST_SOURCES)
        listener.setblocking(False)  # noqa: FBT003 - positional only
    except OSError:
        listener.close()
        raise
    return listener


def take_source(listener: socket.socket) -> Source | None:
    """Accepts a connection; None if it is not of this user, whose name anyone on the machine can read."""
    connection, _ = listener.accept()
    connection.setblocking(False)  # noqa: FBT003 - positional only
    data = connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, _CREDENTIALS.size)
    process, uid, _ = _CREDENTIALS.unpack(data)
    if uid != os.getuid():
        connection.close()
        return None
    return Source(connection, process)


class Source:
    """One connection.

    Attributes:
        connection: its socket.
        process: the process at its other end; 0 if that is not known.
        run: the run to which its messages belong; "" before its first mark.
        is_full: whether as much came at once as the way holds, so that more may wait behind it.
    """

    def __init__(self, connection: socket.socket, process: int = 0) -> None:
        self.connection = connection
        self.process = process
        self.run = ""
        self.is_full = False
        self._data = bytearray()
        self._decode = msgspec.msgpack.Decoder(list[Sent]).decode

    def messages(self) -> Iterator[Sent]:
        """Yields the messages that have arrived.

        Raises:
            BrokenSource: the connection is over, or broken.
        """
        self.is_full = False
        try:
            data = self.connection.recv(READ_BYTES)
        except BlockingIOError:
            return
        except OSError as error:
            raise BrokenSource(str(error)) from error
        if not data:
            raise BrokenSource("it has ended")
        self.is_full = len(data) >= FULL_BYTES
        self._data += data
        while (batch := self._next()) is not None:
            for message in batch:
                if isinstance(message, Mark):
                    self.run = message.run
                yield message

    def _next(self) -> list[Sent] | None:
        if len(self._data) < PREFIX.size:
            return None
        (length,) = PREFIX.unpack_from(self._data)
        if length > MOST_BATCH_BYTES:
            raise BrokenSource(f"it announced a batch of {length} bytes")
        end = PREFIX.size + length
        if len(self._data) < end:
            return None
        body = bytes(memoryview(self._data)[PREFIX.size : end])
        del self._data[:end]
        try:
            batch: list[Sent] = self._decode(body)
        except (msgspec.DecodeError, RecursionError, UnicodeDecodeError) as error:
            raise BrokenSource(f"it sent what is no message: {error}") from error
        return batch
