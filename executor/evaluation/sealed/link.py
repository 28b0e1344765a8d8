"""The socket pair between the two processes of a sealed run, and every message that it carries.

Each message is MessagePack behind its length. The judge's end asks, and the actions' end answers; while an
action waits in rclpy, it asks in turn with `Waits`. What comes from the actions' end is hostile until it is
decoded, and no more than a claim afterwards.
"""

from __future__ import annotations

import select
import struct
from typing import TYPE_CHECKING, Final

import msgspec

if TYPE_CHECKING:
    import socket

MOST_BYTES: Final = 256 << 20
MOST_CLAIMED: Final = 16 << 20
"""The most bytes of a message from the actions."""
_LENGTH: Final = struct.Struct("<I")


class LinkClosedError(Exception):
    """The other end has closed the link."""


class LinkError(Exception):
    """The other end sent something that is no message of the link."""


class Topic(msgspec.Struct, frozen=True):
    """An end of a topic: `types` are the names of its message type, and of those that it may change to."""

    name: str
    types: tuple[str, ...]
    depth: int
    is_latched: bool = False


class Sent(msgspec.Struct, frozen=True, array_like=True):
    """A serialized message of the world, for the publisher of this number."""

    publisher: int
    data: bytes


class Heard(msgspec.Struct, frozen=True, array_like=True):
    """A serialized message of the actions to the world."""

    topic: str
    type: str
    data: bytes


class Load(msgspec.Struct, frozen=True, tag=True):
    """Loads the tree. `seed` is for the actions alone, and shows nothing of the run's own."""

    files: dict[str, bytes]
    tree: str
    seed: int
    tick_hz: float
    on_finish: str
    on_error: str
    publishers: list[Topic]
    subscriptions: list[Topic]
    sent: list[Sent]


class Tick(msgspec.Struct, frozen=True, tag=True):
    """Delivers messages, calls callbacks back, and ticks the tree."""

    time_s: float
    sent: list[Sent]


class Resume(msgspec.Struct, frozen=True, tag=True):
    """Ends a wait: time has passed. `is_over`: the run has no more time."""

    time_s: float
    sent: list[Sent]
    is_over: bool = False


class Switch(msgspec.Struct, frozen=True, tag=True):
    """Makes an action raise, or ends that."""

    tree: str
    node: str
    on: bool


class Look(msgspec.Struct, frozen=True, tag=True):
    """Asks for the results of each node so far."""


class Fault(msgspec.Struct, frozen=True):
    """An exception of the actions, with its place."""

    message: str
    file: str | None = None
    line: int | None = None
    path: str | None = None


class Loaded(msgspec.Struct, frozen=True, tag=True):
    """The tree is loaded. `listeners` is the number of subscribers of each publisher."""

    listeners: list[int]


class Failed(msgspec.Struct, frozen=True, tag=True):
    """The tree cannot be loaded or run; the text says why."""

    text: str


class Ticked(msgspec.Struct, frozen=True, tag=True):
    """The tree was ticked, or an exception of a callback has ended it."""

    listeners: list[int]
    heard: list[Heard]
    status: str | None = None
    last: str = "IDLE"
    is_finished: bool = False
    faults: list[Fault] = []


class Waits(msgspec.Struct, frozen=True, tag=True):
    """An action waits in rclpy."""

    listeners: list[int]
    heard: list[Heard]


class Seen(msgspec.Struct, frozen=True, tag=True):
    """The results of each node by its path, in letters."""

    letters: dict[str, str]


ToActions = Load | Tick | Resume | Switch | Look
ToJudge = Loaded | Failed | Ticked | Waits | Seen
_OF_JUDGE: Final = msgspec.msgpack.Decoder(ToActions)
_OF_ACTIONS: Final = msgspec.msgpack.Decoder(ToJudge)


class Link:
    """One end of the link; it blocks.

    Args:
        end: the socket.
        process_fd: of the process at the other end; its end closes the link, also if a fork of it lives on.
    """

    def __init__(self, end: socket.socket, process_fd: int | None = None) -> None:
        self._end = end
        self._poll = None if process_fd is None else select.poll()
        if self._poll is not None and process_fd is not None:
            for fd in (end.fileno(), process_fd):
                self._poll.register(fd, select.POLLIN)

    def send(self, message: msgspec.Struct) -> None:
        """Sends a message.

        Raises:
            LinkClosedError: the other end has closed the link.
        """
        body = msgspec.msgpack.encode(message)
        try:
            self._end.sendall(_LENGTH.pack(len(body)) + body)
        except OSError as error:
            raise LinkClosedError from error

    def receive_of_judge(self) -> ToActions:
        """Returns the judge's next message. Raises as `_receive` does."""
        message: ToActions = _OF_JUDGE.decode(self._receive(MOST_BYTES))
        return message

    def receive_of_actions(self) -> ToJudge:
        """Returns the next message of the actions.

        Raises:
            LinkClosedError: their process has ended, or has closed the link.
            LinkError: they sent something else.
        """
        try:
            message: ToJudge = _OF_ACTIONS.decode(self._receive(MOST_CLAIMED))
        except (msgspec.DecodeError, RecursionError, UnicodeDecodeError) as error:
            raise LinkError("the process of the actions sent something that is no message") from error
        return message

    def close(self) -> None:
        """Closes this end."""
        self._end.close()

    def _receive(self, most: int) -> bytes:
        (length,) = _LENGTH.unpack(self._exactly(_LENGTH.size))
        if length > most:
            raise LinkError("the process of the actions sent a message that is too long")
        return self._exactly(length)

    def _exactly(self, count: int) -> bytes:
        data = bytearray(count)
        view, done = memoryview(data), 0
        while done < count:
            if self._poll is not None and all(fd != self._end.fileno() for fd, _ in self._poll.poll()):
                raise LinkClosedError
            try:
                got = self._end.recv_into(view[done:])
            except OSError as error:
                raise LinkClosedError from error
            if not got:
                raise LinkClosedError
            done += got
        return bytes(data)
