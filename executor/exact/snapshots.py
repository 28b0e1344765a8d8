"""Snapshots of an exact run: copies of its process that wait until the manager wakes them.

A snapshot waits in `recv` on its end of a socket pair whose other end the manager holds: so it ends when the
manager ends, and survives the process that made it. To wake it, the manager sends its own process id; the
snapshot then forks a copy, which makes the run again from there, and waits on. So it can be woken many times.
"""

from __future__ import annotations

import contextlib
import ctypes
import os
import random
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.exact.foreign import Threads
from executor.supervision import handover
from executor.supervision.channel import socket_pair
from executor.supervision.copies import (
    SNAPSHOT_NAME,
    fork_away,
    forked_copy,
    name_process,
    renew_files,
    stand_alone,
)
from executor.supervision.handover import handover_pair
from executor.supervision.parking import PARKING
from executor.supervision.signs import Notes

if TYPE_CHECKING:
    import socket

__all__ = ["Snapshots", "Woken"]

PARKED_S: Final = 0.05
_YES: Final = b"y"


@dataclass
class Woken:
    """The ends of a copy that was woken: those of its channel, and of the file for its notes."""

    channel_fd: int
    notes_fd: int


def _give_free_memory_back() -> None:
    """Gives the free pages of C's heap back to the system.

    The run continues to use them, and its snapshot would keep each one as it was. With a camera that was a
    fifth of its memory.
    """
    if (trim := getattr(ctypes.CDLL(None), "malloc_trim", None)) is not None:  # other C libraries have none
        trim(0)


class Snapshots:
    """Makes snapshots of this process.

    Args:
        link: the socket to the manager over which they are handed over.
    """

    def __init__(self, link: socket.socket) -> None:
        self._link = link
        self._between: int | None = None

    def take(self, number: int) -> Woken | bool:
        """Makes a snapshot; returns whether that worked.

        In a copy of the snapshot it returns much later, once that was woken.
        """
        self.reap()
        with PARKING.parked(PARKED_S) as are_parked:
            threads = Threads()
            numbers = random.getstate()  # Python seeds its generator again in each fork
            if not are_parked or not threads.are_at_rest:
                return False
            read, write = os.pipe()
            try:
                between = fork_away()
            except OSError:  # too many processes, or too many forks in a short time
                os.close(read)
                os.close(write)
                return False
            if between is not None:
                is_good = threads.have_waited()
                os.close(read)
                with contextlib.suppress(OSError):
                    os.write(write, _YES if is_good else b"n")
                os.close(write)
                self._between = between
                return is_good
            PARKING.forget()
        os.close(write)
        name = Path("/proc/self/comm").read_text().strip()
        name_process(SNAPSHOT_NAME)
        if os.read(read, 1) != _YES:
            os._exit(0)
        os.close(read)
        woken = self._wait(number)
        name_process(name)
        random.setstate(numbers)
        return woken

    def reap(self) -> None:
        """Takes the status of a process that only forked."""
        if self._between is not None:
            with contextlib.suppress(ChildProcessError):
                os.waitpid(self._between, 0)
            self._between = None

    def _wait(self, number: int) -> Woken:
        """Waits, and forks a copy each time that the manager wakes this one; returns in the copy."""
        try:
            mark = stand_alone()
            renew_files()
            _give_free_memory_back()
            theirs, ours = handover_pair()
            handover.send(self._link, number, mark, [theirs.fileno()])
            theirs.close()
            self._link.close()
            ours.setblocking(True)  # noqa: FBT003 - positional only
            while order := ours.recv(32):
                between = fork_away()
                if between is None:
                    return self._wake(ours, int(order))
                os.waitpid(between, 0)
        except BaseException:  # whatever it is, nobody would see it
            os._exit(1)
        os._exit(0)

    def _wake(self, snapshot: socket.socket, manager_pid: int) -> Woken:
        mark = stand_alone()
        forked_copy(manager_pid)
        renew_files()
        channel, own_channel = socket_pair()
        link, self._link = handover_pair()
        notes, own_notes = Notes(), 0
        own_notes = os.dup(notes.fd)
        ends = [channel.fileno(), link.fileno(), notes.fd]
        for standard in (1, 2):
            read, write = os.pipe()
            os.dup2(write, standard)
            os.close(write)
            ends.append(read)
        handover.send(snapshot, 0, mark, ends)
        for end in (channel, link, snapshot):
            end.close()
        notes.close()
        for fd in ends[3:]:
            os.close(fd)
        return Woken(own_channel.detach(), own_notes)
