"""Reports to the manager whether a child process hangs, and where.

A separate thread sends a `Beat` four times a second from the start of the process. If the beats stop, the
process is frozen, or some code holds Python's interpreter lock. For that case the manager passes a file
(`NOTES_VARIABLE`): on a signal, `faulthandler` writes all stacks into it, in C and therefore without the
lock. The first bytes of the file hold the number of the tree node that is being ticked.
"""

from __future__ import annotations

import faulthandler
import mmap
import os
import sys
import threading
import time
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.child_messages import Beat, Place
from executor.supervision.channel import ChannelClosed
from executor.supervision.confine import TRACE_SIGNAL
from executor.supervision.parking import PARKING
from executor.supervision.threads import own

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

__all__ = ["NOTES_BYTES", "NOTES_VARIABLE", "Pulse", "place_in_our_code"]

NOTES_VARIABLE: Final = "BT_STUDIO_NOTES_FD"
NOTES_BYTES: Final = mmap.PAGESIZE
"""Offset of the stacks in the file; the number of the tree node is before it."""
BEAT_S: Final = 0.25
AWAY_S: Final = 0.5
_ROOT: Final = str(Path(__file__).parents[2]) + os.sep


def place_in_our_code(frame: FrameType | None) -> Place:
    """Returns the innermost line of a stack that is in this repository; an empty place if there is none."""
    while frame is not None:
        file = frame.f_code.co_filename
        if file.startswith(_ROOT) and "site-packages" not in file:
            return Place(f"{file.removeprefix(_ROOT)}:{frame.f_lineno}")
        frame = frame.f_back
    return Place()


class Pulse:
    """Sends the beats of this process. Create it on the main thread, before anything slow.

    Attributes:
        clocks: number of times that the process received or published simulated time.
        ticks: number of ticks that an exact run has begun.
        locate: returns the place of a frame of the main thread.
        current: the number of the tree node that is being ticked; the manager reads it from the file.
    """

    def __init__(self, send: Callable[[Beat], None]) -> None:
        self._send = send
        self._main = threading.main_thread().ident or 0
        self._turns = 0
        self._task = "starting"
        self.clocks = self.ticks = 0
        self.locate: Callable[[FrameType | None], Place] = place_in_our_code
        self.current = _take_notes(int(os.environ.pop(NOTES_VARIABLE, "-1")))
        own(threading.Thread(target=self._beat, name="pulse", daemon=True)).start()

    def restart(self, notes_fd: int) -> None:
        """Continues in a copy of the process, with a file of its own for the notes."""
        faulthandler.unregister(TRACE_SIGNAL)
        self.current = _take_notes(notes_fd)
        own(threading.Thread(target=self._beat, name="pulse", daemon=True)).start()

    def moved(self) -> None:
        """Notes that the main thread completed its loop, or a part of a long task."""
        self._turns += 1

    def rests(self) -> None:
        """Notes that loading has ended and the main thread runs its loop from now on."""
        self._task = ""
        self._turns += 1

    @contextmanager
    def busy(self, task: str) -> Iterator[None]:
        """Marks a task of the main thread that may take long, while the context lasts."""
        before, self._task = self._task, task
        self._turns += 1
        try:
            yield
        finally:
            self._task = before
            self._turns += 1

    def _beat(self) -> None:
        turns, since_s = -1, 0.0
        spot = PARKING.spot()
        with suppress(ChannelClosed):
            while True:
                with spot:
                    now_s = time.monotonic()
                    if self._turns != turns:
                        turns, since_s = self._turns, now_s
                    place = self._place() if now_s - since_s >= AWAY_S else None
                    self._send(Beat(turns, self._task, self.clocks, place, self.ticks))
                time.sleep(BEAT_S)

    def _place(self) -> Place:
        try:
            return self.locate(sys._current_frames().get(self._main))
        except Exception as error:  # the frames of a running thread may change meanwhile
            return Place(f"unknown: {error}")


def _take_notes(fd: int) -> list[int] | memoryview[int]:
    """Registers the stack dump for the manager's signal; -1 is for no file.

    Returns the memory into which the node's number is written.
    """
    if fd < 0:
        return [0]
    os.set_inheritable(fd, False)  # noqa: FBT003 - positional only
    os.lseek(fd, NOTES_BYTES, os.SEEK_SET)
    faulthandler.register(TRACE_SIGNAL, file=fd, all_threads=True)
    return memoryview(mmap.mmap(fd, NOTES_BYTES)).cast("I")
