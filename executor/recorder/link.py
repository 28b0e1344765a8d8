"""The way from a process of a session to its recorder: a socket that never makes its process wait.

The recorder listens at an address in Linux's abstract namespace, so that a recorder that was started again is
found at the same place. What a source sends is kept until the recorder takes it, up to a bound; beyond it
messages are dropped, and the source sends its whole state again once there is room.
"""

from __future__ import annotations

import os
import socket
import struct
import time
from typing import TYPE_CHECKING, Any, Final

import msgspec
from msgspec import Struct

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ADDRESS_VARIABLE", "MOST_MESSAGE_BYTES", "Dump", "Heard", "Mark", "Record", "RecorderLink"]

ADDRESS_VARIABLE: Final = "BT_STUDIO_RECORDER"
PREFIX: Final = struct.Struct("<I")
MOST_MESSAGE_BYTES: Final = 16 << 20
MOST_WAITING_BYTES: Final = 16 << 20
BATCH_S: Final = 0.2
BATCH_BYTES: Final = 64 << 10
RETRY_S: Final = 1.0


class Mark(Struct, tag="mark"):
    """Marks that all that follows belongs to a run."""

    run: str


class Record(Struct, tag="record"):
    """A message of one of our types; its field `stamp` is a time in ns."""

    topic: str
    name: str
    fields: dict[str, Any]


class Heard(Struct, tag="heard"):
    """A message of a ROS topic, as CDR."""

    topic: str
    kind: str
    t_ns: int
    data: bytes


class Dump(Struct, tag="dump"):
    """The state of the world after a step."""

    t_ns: int
    step: int
    data: bytes


Sent = Mark | Record | Heard | Dump


class RecorderLink:
    """A source's end. All methods are called on one thread.

    Args:
        address: the recorder's address; "" for none, and then nothing is recorded.
        restate: is called when the recorder needs the whole state of this source: at the begin of a run,
            after a lost connection, and after dropped messages.
    """

    def __init__(
        self,
        address: str,
        restate: Callable[[], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._address = address
        self._restate = restate
        self._clock = clock
        self._encode = msgspec.msgpack.Encoder().encode
        self._socket: socket.socket | None = None
        self._run = ""
        self._waiting = bytearray()
        self._sent_s = self._tried_s = -RETRY_S
        self._has_dropped = False
        os.register_at_fork(after_in_child=self._abandon)

    @property
    def is_recording(self) -> bool:
        """Whether a run has begun and its recorder can be reached."""
        return bool(self._run) and self._socket is not None

    def begin(self, run: str) -> None:
        """Begins another run: all that is sent from now on belongs to it."""
        self._run = run
        if self._is_connected():
            self._tell_all()

    def send(self, message: Record | Heard | Dump) -> None:
        """Sends a message of the run, soon; drops it if the recorder is too slow, or not there."""
        if self.is_recording:
            self._put(message)
            if len(self._waiting) >= BATCH_BYTES or self._clock() - self._sent_s >= BATCH_S:
                self._write()

    def pump(self) -> None:
        """Sends the waiting messages, and reconnects to a lost recorder. Called many times in a second."""
        if not self._run:
            return
        if self._socket is None:
            if self._is_connected():
                self._tell_all()
            return
        if self._has_dropped and not self._waiting:
            self._has_dropped = False
            self._tell_all()
        if self._waiting and self._clock() - self._sent_s >= BATCH_S:
            self._write()

    def flush(self, patience_s: float) -> None:
        """Sends all that waits, for at most this time."""
        end_s = self._clock() + patience_s
        while self._waiting and self._socket is not None and self._clock() < end_s:
            self._write()
            if self._waiting and self._socket is not None:
                time.sleep(0.005)

    def close(self) -> None:
        """Ends the connection."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None
        self._waiting.clear()

    # --- inside ---

    def _tell_all(self) -> None:
        self._waiting_put(self._encode(Mark(self._run)))
        self._restate()
        self._write()

    def _put(self, message: Sent) -> None:
        self._waiting_put(self._encode(message))

    def _waiting_put(self, data: bytes) -> None:
        if len(data) > MOST_MESSAGE_BYTES or len(self._waiting) + len(data) > MOST_WAITING_BYTES:
            self._has_dropped = self._has_dropped or len(data) <= MOST_MESSAGE_BYTES
            return
        self._waiting += PREFIX.pack(len(data))
        self._waiting += data

    def _is_connected(self) -> bool:
        now_s = self._clock()
        if self._socket is None and self._address and now_s - self._tried_s >= RETRY_S:
            self._tried_s = now_s
            candidate = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
            candidate.setblocking(False)  # noqa: FBT003 - positional only
            try:
                candidate.connect(f"\0{self._address}")
            except OSError:
                candidate.close()
            else:
                self._socket = candidate
                self._waiting.clear()
                self._has_dropped = False
        return self._socket is not None

    def _write(self) -> None:
        if self._socket is None:
            return
        self._sent_s = self._clock()
        try:
            sent = self._socket.send(self._waiting, socket.MSG_NOSIGNAL) if self._waiting else 0
        except BlockingIOError:
            return
        except OSError:
            self.close()  # `pump` looks for the next recorder
            return
        del self._waiting[:sent]

    def _abandon(self) -> None:
        """Closes the connection in a process that an action forked."""
        self._run = ""
        self.close()
