"""What a child process does so that the manager hears whether it hangs, and where.

A thread of its own sends a *beat* four times a second, from the first moment on: how often the main thread
came round, what it loads if it loads, and where it is if it has not come round for a while. No beat at all
means that the process is frozen, or that something holds Python's interpreter lock. For that case the manager
gave us a file (`NOTES_VARIABLE`): by a signal, `faulthandler` writes there in C where each thread is, and its
first bytes are the number of the node that is being ticked.
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
from typing import TYPE_CHECKING, Any, Final

from executor.supervision.channel import ChannelClosed
from executor.supervision.confine import TRACE_SIGNAL

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

__all__ = ["NOTES_BYTES", "NOTES_VARIABLE", "Pulse", "place_in_our_code"]

NOTES_VARIABLE: Final = "BT_STUDIO_NOTES_FD"
NOTES_BYTES: Final = mmap.PAGESIZE
"""Where in the file of notes the traces begin; before that is the number of the node."""
BEAT_S: Final = 0.25
AWAY_S: Final = 0.5
_ROOT: Final = str(Path(__file__).parents[2]) + os.sep


def place_in_our_code(frame: FrameType | None) -> dict[str, Any]:
    """Returns the innermost line of a stack that is in this repository."""
    while frame is not None:
        file = frame.f_code.co_filename
        if file.startswith(_ROOT) and "site-packages" not in file:
            return {"text": f"{file.removeprefix(_ROOT)}:{frame.f_lineno}"}
        frame = frame.f_back
    return {}


class Pulse:
    """Beats for this process. Make it on the main thread, before anything that takes long.

    Attributes:
        clocks: how many times the process heard, or told, what simulated time it is.
        locate: says where a frame of the main thread is, for people and for the manager.
        current: the number of the node that is being ticked; visible from outside.
    """

    def __init__(self, send: Callable[[dict[str, Any]], None]) -> None:
        self._send = send
        self._main = threading.main_thread().ident or 0
        self._turns = 0
        self._task = "starting"
        self.clocks = 0
        self.locate: Callable[[FrameType | None], dict[str, Any]] = place_in_our_code
        self.current = _take_notes()
        threading.Thread(target=self._beat, name="pulse", daemon=True).start()

    def moved(self) -> None:
        """The main thread has come round, or made a step of a long piece of work."""
        self._turns += 1

    def rests(self) -> None:
        """What was loaded is there: from now on the main thread comes round again and again."""
        self._task = ""
        self._turns += 1

    @contextmanager
    def busy(self, task: str) -> Iterator[None]:
        """Says that the main thread does something that may take long, as long as it computes."""
        before, self._task = self._task, task
        self._turns += 1
        try:
            yield
        finally:
            self._task = before
            self._turns += 1

    def _beat(self) -> None:
        turns, since_s = -1, 0.0
        with suppress(ChannelClosed):
            while True:
                now_s = time.monotonic()
                if self._turns != turns:
                    turns, since_s = self._turns, now_s
                beat = {"type": "beat", "turns": turns, "task": self._task, "clocks": self.clocks}
                if now_s - since_s >= AWAY_S:
                    beat["place"] = self._place()
                self._send(beat)
                time.sleep(BEAT_S)

    def _place(self) -> dict[str, Any]:
        try:
            return self.locate(sys._current_frames().get(self._main))
        except Exception as error:  # the frames of a thread that runs may change under our hands
            return {"text": f"unknown: {error}"}


def _take_notes() -> list[int] | memoryview[int]:
    """Has the manager's signal answered into its file; returns where the node's number is to be written."""
    given = os.environ.pop(NOTES_VARIABLE, "")
    if not given:
        return [0]
    fd = int(given)
    os.set_inheritable(fd, False)  # noqa: FBT003 - positional only
    os.lseek(fd, NOTES_BYTES, os.SEEK_SET)
    faulthandler.register(TRACE_SIGNAL, file=fd, all_threads=True)
    return memoryview(mmap.mmap(fd, NOTES_BYTES)).cast("I")
