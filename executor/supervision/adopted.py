"""A process that the manager did not start: the copy of a snapshot, which it adopted."""

from __future__ import annotations

import contextlib
import os
import socket
import stat
from typing import TYPE_CHECKING, BinaryIO, Final

from executor.supervision.pulse import NOTES_BYTES

if TYPE_CHECKING:
    from executor.supervision.handover import Arrival

__all__ = ["AdoptedProcess"]

_ENDS: Final = 5
UNKNOWN_CODE: Final = -9
"""The status of a process that somebody else has taken."""


class AdoptedProcess:
    """The ends of a process that was handed over, checked: users' code runs in it.

    Args:
        arrival: the process; this object owns its descriptors.

    Raises:
        ValueError: they are not what they must be.
    """

    def __init__(self, arrival: Arrival) -> None:
        fds, arrival.fds = arrival.fds, []
        with contextlib.ExitStack() as failed:
            for fd in fds:
                failed.callback(os.close, fd)
            if len(fds) != _ENDS:
                raise ValueError(f"{len(fds)} descriptors")
            channel, link, notes, out, err = fds
            modes = [os.fstat(fd).st_mode for fd in fds]
            if not (
                all(stat.S_ISSOCK(mode) for mode in modes[:2])
                and all(stat.S_ISFIFO(mode) for mode in modes[3:])
                and stat.S_ISREG(modes[2])
                and os.fstat(notes).st_size >= NOTES_BYTES
            ):
                raise ValueError("other descriptors than expected")
            failed.pop_all()
        self.pid = arrival.pid
        self.mark = arrival.mark
        self.channel = socket.socket(fileno=channel)
        self.link = socket.socket(fileno=link)
        self.link.setblocking(False)  # noqa: FBT003 - positional only
        self.notes_fd = notes
        self.stdout: BinaryIO = os.fdopen(out, "rb", 0)
        self.stderr: BinaryIO = os.fdopen(err, "rb", 0)

    def wait(self) -> int:
        """Waits for the end of the process; returns its status as `subprocess` does."""
        try:
            _, status = os.waitpid(self.pid, 0)
        except ChildProcessError:
            return UNKNOWN_CODE
        return os.waitstatus_to_exitcode(status)
