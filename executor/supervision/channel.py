"""Messages between the manager and its children: length-prefixed MessagePack over a socket pair.

The messages are those of `executor.child_messages`; each end is created with the union of the messages that
it receives. The child's end (`Channel`) is synchronous and may be used from any thread; the manager's end
(`AsyncChannel`) belongs to an event loop. Both are bounded: a newer `Frame` of the same client and stream
replaces one that waits, unless `keep` is set (as for a scene, to which later frames refer). All other
messages are control messages and are never dropped. An other end that does not read them for
`STALL_TIMEOUT_S` counts as dead.

    ChannelError
    └── ChannelClosed    the other end has ended, or does not read
"""

from __future__ import annotations

import asyncio
import os
import select
import socket
import struct
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Final, Generic, TypeVar

import msgspec

from executor.child_messages import Frame, name_of
from executor.stream.frames import supersede
from executor.supervision.encoding import encode_message
from executor.supervision.threads import own

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["AsyncChannel", "Channel", "ChannelClosed", "ChannelError", "encode", "socket_pair"]

FrameKey = tuple[str | None, str]
Sent = TypeVar("Sent", bound=msgspec.Struct)
Received = TypeVar("Received")

MAX_MESSAGE_BYTES: Final = 256 * 1024 * 1024
MAX_QUEUED_BYTES: Final = 64 * 1024 * 1024
SOCKET_BUFFER_BYTES: Final = 256 * 1024
STALL_TIMEOUT_S: Final = 10.0
_PREFIX: Final = struct.Struct("<I")


class ChannelError(Exception):
    """The other end violated the protocol of the channel."""


class ChannelClosed(ChannelError):  # noqa: N818 - it is an event more than an error
    """The other end of the channel has ended."""


def socket_pair() -> tuple[socket.socket, socket.socket]:
    """Returns the manager's and the child's end of a new channel."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
    for end in (ours, theirs):
        end.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, SOCKET_BUFFER_BYTES)
    return ours, theirs


def encode(message: msgspec.Struct) -> bytes:
    """Returns the bytes of a message, with its length as prefix."""
    body = encode_message(message)
    if len(body) > MAX_MESSAGE_BYTES:
        raise ChannelError(f"a {name_of(message)} message of {len(body)} bytes is too large for the channel")
    return _PREFIX.pack(len(body)) + body


def _decode(decode: Callable[[bytes], Received], body: bytes) -> Received:
    try:
        return decode(body)
    except (msgspec.DecodeError, RecursionError, UnicodeDecodeError) as error:
        raise ChannelError(f"a message does not decode: {error}") from error


class _Outbox:
    """Messages that wait to be written: control messages in order, then the latest frame of each stream."""

    def __init__(self) -> None:
        self.control: deque[bytes] = deque()
        self.frames: dict[FrameKey, Frame] = {}
        self.control_bytes = 0

    def __bool__(self) -> bool:
        return bool(self.control or self.frames)

    def put(self, message: msgspec.Struct) -> None:
        if isinstance(message, Frame):
            waiting = self.frames.pop((message.client, message.stream), None)
            if not message.keep:
                if waiting is not None:
                    data = supersede(waiting.data, message.data)
                    message = Frame(message.client, message.stream, data)
                self.frames[message.client, message.stream] = message
                return
            # A frame with `keep` is never dropped. It makes `waiting`, which is older, superfluous.
        data = encode(message)
        self.control.append(data)
        self.control_bytes += len(data)

    def take(self) -> bytes:
        if self.control:
            data = self.control.popleft()
            self.control_bytes -= len(data)
            return data
        return encode(self.frames.pop(next(iter(self.frames))))


class Channel(Generic[Sent, Received]):
    """The child's end of a channel, made from the file descriptor that the child was given.

    Args:
        fd: the descriptor; the channel owns it from now on.
        decode: converts the bytes that the other end sends to a message.
    """

    def __init__(self, fd: int, decode: Callable[[bytes], Received]) -> None:
        self._decode = decode
        os.set_inheritable(fd, False)  # noqa: FBT003 - positional only
        self._socket = socket.socket(fileno=fd)
        self._socket.settimeout(0)
        self._received = bytearray()
        self._outbox = _Outbox()
        self._writing = b""
        self._changed = threading.Condition()
        self._closed = False
        self._writer: threading.Thread | None = None
        # A program that an action forks must not write to the channel.
        os.register_at_fork(after_in_child=self._abandon)

    def reopen(self, fd: int) -> None:
        """Continues on another socket, in a copy of the process; what waited belongs to the first one."""
        os.set_inheritable(fd, False)  # noqa: FBT003 - positional only
        self._socket = socket.socket(fileno=fd)
        self._socket.settimeout(0)
        self._received, self._outbox, self._writing = bytearray(), _Outbox(), b""
        self._writer, self._closed = None, False

    def wait(self) -> None:
        """Waits until something has arrived, or the other end has ended."""
        self._poll(select.POLLIN, None)

    def fileno(self) -> int:
        """Returns the descriptor to wait on.

        When it is readable, call `receive(0)` until that returns None.
        """
        return self._socket.fileno()

    def send(self, message: Sent) -> None:
        """Queues a message, and writes it immediately if that does not block.

        Raises:
            ChannelClosed: the manager has ended, or has not read for `STALL_TIMEOUT_S`.
        """
        with self._changed:
            deadline = time.monotonic() + STALL_TIMEOUT_S
            while self._outbox.control_bytes > MAX_QUEUED_BYTES and not self._closed:
                if not self._changed.wait(deadline - time.monotonic()):
                    self._close()
            if self._closed:
                raise ChannelClosed("the manager is gone")
            self._outbox.put(message)
            self._write_some()
            if self._outbox or self._writing:
                self._start_writer()
                self._changed.notify_all()

    def receive(self, timeout_s: float | None = None) -> Received | None:
        """Waits for the next message and returns it; returns None after the timeout.

        Without a timeout the wait has no limit.

        Raises:
            ChannelClosed: the manager has ended.
            ChannelError: a message cannot be decoded.
        """
        deadline = None if timeout_s is None else time.monotonic() + timeout_s
        while True:
            message = self._take_received()
            if message is not None:
                return message
            left = None if deadline is None else max(0.0, deadline - time.monotonic())
            if not self._poll(select.POLLIN, left):
                return None
            self._read()

    def flush(self, timeout_s: float = STALL_TIMEOUT_S) -> bool:
        """Waits until all messages are written, or until the timeout; returns whether all were written."""
        with self._changed:
            return (
                self._changed.wait_for(lambda: self._closed or not (self._outbox or self._writing), timeout_s)
                and not self._closed
            )

    def close(self) -> None:
        """Ends the channel; messages that are not written yet are lost. May be called twice."""
        with self._changed:
            self._close()

    def _take_received(self) -> Received | None:
        if len(self._received) < _PREFIX.size:
            return None
        (length,) = _PREFIX.unpack_from(self._received)
        if length > MAX_MESSAGE_BYTES:
            raise ChannelError(f"a message of {length} bytes is too large")
        end = _PREFIX.size + length
        if len(self._received) < end:
            return None
        body = bytes(memoryview(self._received)[_PREFIX.size : end])
        del self._received[:end]
        return _decode(self._decode, body)

    def _read(self) -> None:
        try:
            data = self._socket.recv(1 << 20)
        except BlockingIOError:
            return
        except OSError as error:
            raise ChannelClosed("the manager is gone") from error
        if not data:
            raise ChannelClosed("the manager closed the channel")
        self._received += data

    def _poll(self, event: int, timeout_s: float | None) -> bool:
        fd = self._socket.fileno()
        if fd < 0:
            raise ChannelClosed("the channel is closed")
        poll = select.poll()
        poll.register(fd, event)
        return bool(poll.poll(None if timeout_s is None else timeout_s * 1000))

    def _write_some(self) -> None:
        while self._writing or self._outbox:
            if not self._writing:
                self._writing = self._outbox.take()
            try:
                sent = self._socket.send(self._writing, socket.MSG_NOSIGNAL)
            except BlockingIOError:
                return
            except OSError:
                self._close()
                return
            self._writing = self._writing[sent:]

    def _start_writer(self) -> None:
        if self._writer is None:
            self._writer = own(threading.Thread(target=self._write_backlog, name="channel", daemon=True))
            self._writer.start()

    def _write_backlog(self) -> None:
        while True:
            with self._changed:
                self._changed.wait_for(lambda: self._closed or self._outbox or self._writing)
                if self._closed:
                    return
            try:
                writable = self._poll(select.POLLOUT, STALL_TIMEOUT_S)
            except (ChannelClosed, OSError, ValueError):
                writable = False
            with self._changed:
                if writable:
                    self._write_some()
                else:
                    self._close()
                self._changed.notify_all()

    def _close(self) -> None:
        self._closed = True
        self._socket.close()
        self._changed.notify_all()

    def _abandon(self) -> None:
        self._closed = True
        self._socket.close()
        self._changed = threading.Condition()


class AsyncChannel(Generic[Sent, Received]):
    """The manager's end of a channel; make it with `AsyncChannel.open`."""

    def __init__(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        decode: Callable[[bytes], Received],
    ) -> None:
        self._decode = decode
        self._reader = reader
        self._writer = writer

    @classmethod
    async def open(
        cls, ours: socket.socket, decode: Callable[[bytes], Received]
    ) -> AsyncChannel[Sent, Received]:
        """Takes ownership of the manager's end of a socket pair."""
        ours.settimeout(0)
        return cls(*await asyncio.open_connection(sock=ours), decode)

    def send(self, message: Sent) -> None:
        """Writes a message without waiting.

        Raises:
            ChannelClosed: the child has ended, or does not read its messages.
        """
        if self._writer.is_closing():
            raise ChannelClosed("the process is gone")
        if self._writer.transport.get_write_buffer_size() > MAX_QUEUED_BYTES:
            raise ChannelClosed("the process does not read its messages")
        self._writer.write(encode(message))

    async def receive(self) -> Received:
        """Waits for the next message, and returns it.

        Raises:
            ChannelClosed: the child has ended.
            ChannelError: a message cannot be decoded.
        """
        try:
            (length,) = _PREFIX.unpack(await self._reader.readexactly(_PREFIX.size))
            if length > MAX_MESSAGE_BYTES:
                raise ChannelError(f"a message of {length} bytes is too large")
            return _decode(self._decode, await self._reader.readexactly(length))
        except (asyncio.IncompleteReadError, OSError) as error:
            raise ChannelClosed("the process closed its channel") from error

    def close(self) -> None:
        """Ends the channel. May be called twice."""
        self._writer.close()
