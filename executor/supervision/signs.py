"""State of a process as the kernel reports it: whether it computes, waits for a processor, or is stopped."""

from __future__ import annotations

import asyncio
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from executor.supervision.confine import TRACE_SIGNAL
from executor.supervision.pulse import NOTES_BYTES

__all__ = ["Notes", "Signs", "look_at"]

TRACE_S: Final = 2.0
TRACE_STEP_S: Final = 0.02
LARGEST_TRACE_BYTES: Final = 64 * 1024
_TICK_S: Final = 1.0 / os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True)
class Signs:
    """Times of a process's main thread in seconds since its start; `state` is the letter of proc(5).

    `waited_s` is the time for which it was ready to run, but had no processor. Other threads do not count:
    threads that wait for the interpreter lock wake up all the time, and on a busy machine that looks like
    waiting for a processor.
    """

    state: str
    ran_s: float
    waited_s: float


def look_at(pid: int) -> Signs | None:
    """Samples a process; returns None if it has ended."""
    try:
        # The name may contain any character; it ends at the last parenthesis.
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    except OSError:
        return None
    try:
        ran_ns, waited_ns, _ = Path(f"/proc/{pid}/schedstat").read_text().split()
    except (OSError, ValueError):  # this kernel does not have the counter
        return Signs(fields[0], (int(fields[11]) + int(fields[12])) * _TICK_S, 0.0)
    return Signs(fields[0], int(ran_ns) * 1e-9, int(waited_ns) * 1e-9)


class Notes:
    """The file into which a process that does not respond writes its stacks.

    Args:
        fd: the descriptor of the file; None creates a new file.
    """

    def __init__(self, fd: int | None = None) -> None:
        if fd is None:
            fd = os.memfd_create("bt-studio-notes", os.MFD_CLOEXEC)
            os.ftruncate(fd, NOTES_BYTES)
        self.fd = fd

    def current_uid(self) -> int:
        """Returns the number of the tree node that is being ticked; 0 if none is."""
        return int.from_bytes(os.pread(self.fd, 4, 0), "little")

    async def trace(self, pid: int) -> str:
        """Makes a process write its stacks, and returns them; "" if it writes none."""
        before = self._size()
        try:
            os.kill(pid, TRACE_SIGNAL)
        except ProcessLookupError:
            return ""
        size = before
        for _ in range(round(TRACE_S / TRACE_STEP_S)):
            await asyncio.sleep(TRACE_STEP_S)
            if size > before and self._size() == size:
                break  # the output has ended
            size = self._size()
        data = os.pread(self.fd, min(size - before, LARGEST_TRACE_BYTES), before)
        return data.decode("utf-8", "replace")

    def close(self) -> None:
        """Closes the file. May be called twice."""
        if self.fd >= 0:
            os.close(self.fd)
            self.fd = -1

    def _size(self) -> int:
        return max(os.fstat(self.fd).st_size, NOTES_BYTES) if self.fd >= 0 else NOTES_BYTES
