"""The way from a process of a session to its recorder: a socket that never makes its process wait.

The recorder listens at an address in Linux's abstract namespace, so that a recorder that was started again is
found at the same place. What a source sends is kept until the recorder takes it, up to a bound; beyond it
messages are dropped, and the source sends its whole state again once there is room.

Messages go in batches, two in a second, at the same moments in all processes of the machine: so the recorder
wakes twice in a second for all of them. A batch is one MessagePack list, with its length before it. It ends
with the time up to which the source has sent everything, so that no message waits for one that does not come.
"""

from __future__ import annotations

import os
import socket
import struct
import time
from typing import TYPE_CHECKING, Any, Final

from msgspec import Struct

from executor.supervision.encoding import encode_message

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

__all__ = [
    "ADDRESS_VARIABLE",
    "BATCH_S",
    "MOST_BATCH_BYTES",
    "Dump",
    "Heard",
    "Mark",
    "Record",
    "RecorderLink",
    "Until",
    "next_batch_s",
]

ADDRESS_VARIABLE: Final = "BT_STUDIO_RECORDER"
PREFIX: Final = struct.Struct("<I")
MOST_MESSAGE_BYTES: Final = 16 << 20
MOST_WAITING_BYTES: Final = 16 << 20
BATCH_S: Final = 0.5
BATCH_BYTES: Final = 64 << 10
MOST_BATCH_BYTES: Final = MOST_MESSAGE_BYTES + 64
RETRY_S: Final = 1.0
_LIST: Final = struct.Struct(">BI")
_LIST_CODE: Final = 0xDD
"""The first byte of a list in MessagePack whose length has 32 bits."""


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


class Until(Struct, tag="until"):
    """Marks the time before which nothing comes any more."""

    t_ns: int


Sent = Mark | Record | Heard | Dump | Until


def next_batch_s(now_s: float) -> float:
    """Returns the next moment of monotonic time at which all sources send."""
    return (now_s // BATCH_S + 1) * BATCH_S


class RecorderLink:
    """A source's end. All methods are called on one thread.

    Args:
        address: the recorder's address; "" for none, and then nothing is recorded.
        restate: is called when the recorder needs the whole state of this source: at the begin of a run,
            after a lost connection, and after dropped messages.
        gather: returns what the source held back for a batch, and the time that it has reached; is called
            before each.
    """

    def __init__(
        self,
        address: str,
        restate: Callable[[], None],
        clock: Callable[[], float] = time.monotonic,
        gather: Callable[[], Iterable[Record | Until]] = tuple,
    ) -> None:
        self._address = address
        self._restate = restate
        self._clock = clock
        self._gather = gather
        self._socket: socket.socket | None = None
        self._run = ""
        self._batch: list[bytes] = []
        self._batch_bytes = 0
        self._waiting = bytearray()
        self._due_s = 0.0
        self._tried_s = -RETRY_S
        self._has_dropped = False
        self._is_gathering = False
        os.register_at_fork(after_in_child=self._abandon)

    @property
    def is_recording(self) -> bool:
        """Whether a run has begun and its recorder can be reached."""
        return bool(self._run) and self._socket is not None

    def begin(self, run: str) -> None:
        """Begins another run: all that is sent from now on belongs to it."""
        self._put_gathered()
        self._run = run
        if self._is_connected():
            self._tell_all()

    def send(self, message: Record | Heard | Dump) -> None:
        """Sends a message of the run, soon; drops it if the recorder is too slow, or not there."""
        if self.is_recording:
            self._put(message)
            if self._batch_bytes >= BATCH_BYTES:
                self._finish_batch()

    def pump(self) -> None:
        """Sends the waiting messages, and reconnects to a lost recorder. Called many times in a second."""
        now_s = self._clock()
        if now_s < self._due_s:
            if self._waiting:
                self._write()
            return
        self._due_s = next_batch_s(now_s)
        if not self._run:
            return
        if self._socket is None:
            if self._is_connected():
                self._tell_all()
            return
        if self._has_dropped and not self._waiting:
            self._has_dropped = False
            self._tell_all()
        self._finish_batch()

    def flush(self, patience_s: float) -> None:
        """Sends all that waits, for at most this time."""
        end_s = self._clock() + patience_s
        self._finish_batch()
        while self._waiting and self._socket is not None and self._clock() < end_s:
            self._write()
            if self._waiting and self._socket is not None:
                time.sleep(0.005)

    def close(self) -> None:
        """Ends the connection."""
        if self._socket is not None:
            self._socket.close()
            self._socket = None
        self._clear()

    def _tell_all(self) -> None:
        self._put(Mark(self._run))
        self._restate()
        self._finish_batch()

    def _put_gathered(self) -> None:
        if self.is_recording and not self._is_gathering:  # what is gathered may fill a batch
            self._is_gathering = True
            for message in self._gather():
                self._put(message)
            self._is_gathering = False

    def _put(self, message: Sent) -> None:
        data = encode_message(message)
        if len(data) > MOST_MESSAGE_BYTES:
            return
        if len(self._waiting) + self._batch_bytes + len(data) > MOST_WAITING_BYTES:
            self._has_dropped = True
            return
        if self._batch_bytes + len(data) > BATCH_BYTES:
            self._close_batch()
        self._batch.append(data)
        self._batch_bytes += len(data)

    def _finish_batch(self) -> None:
        """Sends the open batch, as far as the recorder takes it at once."""
        self._put_gathered()
        self._close_batch()
        if self._waiting:
            self._write()

    def _close_batch(self) -> None:
        if self._batch:
            self._waiting += PREFIX.pack(_LIST.size + self._batch_bytes)
            self._waiting += _LIST.pack(_LIST_CODE, len(self._batch))
            self._waiting += b"".join(self._batch)
            self._batch, self._batch_bytes = [], 0

    def _clear(self) -> None:
        self._waiting.clear()
        self._batch, self._batch_bytes = [], 0

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
                self._clear()
                self._has_dropped = False
        return self._socket is not None

    def _write(self) -> None:
        if self._socket is None:
            return
        try:
            sent = self._socket.send(self._waiting, socket.MSG_NOSIGNAL)
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
