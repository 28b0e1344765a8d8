"""Hands processes over to the manager: a copy of a process sends it the descriptors of its ends.

The socket keeps the limits of packets, and the kernel adds who sent one: what a packet says about its process
cannot be wrong. Users' code runs in the processes that send, so everything else is checked.
"""

from __future__ import annotations

import array
import contextlib
import os
import re
import socket
import struct
from dataclasses import dataclass, field
from typing import Final

__all__ = ["HANDOVER_VARIABLE", "Arrival", "handover_pair", "receive", "sees_senders", "send"]

HANDOVER_VARIABLE: Final = "BT_STUDIO_HANDOVER_FD"
MOST_FDS: Final = 8
_CREDENTIALS: Final = struct.Struct("3i")
_TEXT: Final = re.compile(rb"(\d{1,9}) ([0-9a-f]{16})")
_PACKET_BYTES: Final = 64


@dataclass
class Arrival:
    """A process that was handed over.

    Attributes:
        number: the number that the sender gave it.
        mark: the mark of its descendants in their environment.
        pid: its id, as the kernel says.
        fds: the descriptors; who takes them closes them.
    """

    number: int
    mark: str
    pid: int
    fds: list[int] = field(default_factory=list)

    def close(self) -> None:
        """Closes the descriptors."""
        for fd in self.fds:
            os.close(fd)
        self.fds = []


def handover_pair() -> tuple[socket.socket, socket.socket]:
    """Returns the manager's and the process's end of a socket for this."""
    ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    sees_senders(ours)
    return ours, theirs


def sees_senders(end: socket.socket) -> None:
    """Makes the kernel add to each packet of an end who sent it."""
    end.setsockopt(socket.SOL_SOCKET, socket.SO_PASSCRED, 1)
    end.setblocking(False)  # noqa: FBT003 - positional only


def send(end: socket.socket, number: int, mark: str, fds: list[int]) -> None:
    """Hands this process over.

    Raises:
        OSError: the manager is gone.
    """
    rights = (socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", fds))
    end.sendmsg([f"{number} {mark}".encode()], [rights], socket.MSG_NOSIGNAL)


def receive(end: socket.socket) -> Arrival | None:
    """Returns the next process that was handed over; None for a packet that is not one.

    Raises:
        BlockingIOError: there is none.
        EOFError: no process holds the other end any more.
        OSError: the socket is broken.
    """
    room = socket.CMSG_SPACE(MOST_FDS * 4) + socket.CMSG_SPACE(_CREDENTIALS.size)
    data, ancillary, _, _ = end.recvmsg(_PACKET_BYTES, room, socket.MSG_CMSG_CLOEXEC)
    fds, pid = array.array("i"), 0
    for level, kind, value in ancillary:
        if level == socket.SOL_SOCKET and kind == socket.SCM_RIGHTS:
            fds.frombytes(value[: len(value) - len(value) % fds.itemsize])
        elif level == socket.SOL_SOCKET and kind == socket.SCM_CREDENTIALS:
            pid = _CREDENTIALS.unpack(value[: _CREDENTIALS.size])[0]
    found = _TEXT.fullmatch(data)
    if found is None or pid <= 0:
        for fd in fds:
            with contextlib.suppress(OSError):
                os.close(fd)
        if not data:
            raise EOFError
        return None
    return Arrival(int(found[1]), found[2].decode(), pid, list(fds))
