"""Samples the Python code of one leaf: which lines its ticks spend their time in."""

from __future__ import annotations

import sys
import threading
from collections import Counter
from typing import TYPE_CHECKING, Final

from executor.application.locate import is_action_file
from executor.messages import SampledStack

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

__all__ = ["Sampler"]

INTERVAL_S: Final = 0.005
MOST_STACKS: Final = 200
MOST_KEPT: Final = 2_000
"""So many different stacks are counted at most; those after them count as samples alone."""
MOST_FRAMES: Final = 40
LONGEST_FRAME: Final = 200


class Sampler:
    """Looks 200 times a second at the thread that ticks, while a leaf is being ticked.

    Python runs one thread at a time, so a look waits until the leaf's code lets other threads run: code in C
    that keeps the interpreter for long is seen at its end.

    Args:
        uid: the leaf.
        current: returns the uid of the leaf that is being ticked, 0 between leaves.
        thread_id: the thread that ticks; the calling one without it.
    """

    def __init__(self, uid: int, current: Callable[[], int], thread_id: int | None = None) -> None:
        self.uid = uid
        self._current = current
        self._thread_id = thread_id or threading.get_ident()
        self._found: Counter[tuple[str, ...]] = Counter()
        self._samples = 0
        self._is_over = threading.Event()
        thread = threading.Thread(target=self._run, name="sampler", daemon=True)
        thread.pydev_do_not_trace = thread.is_pydev_daemon_thread = True  # type: ignore[attr-defined]
        thread.start()

    @property
    def samples(self) -> int:
        """The number of times that the leaf was seen."""
        return self._samples

    def stacks(self) -> list[SampledStack]:
        """Returns the stacks that were seen most, the outermost call first."""
        return [SampledStack(list(frames), n) for frames, n in self._found.most_common(MOST_STACKS)]

    def close(self) -> None:
        """Ends sampling."""
        self._is_over.set()

    def _run(self) -> None:
        while not self._is_over.wait(INTERVAL_S):
            if self._current() == self.uid:
                self.look(sys._current_frames().get(self._thread_id))

    def look(self, frame: FrameType | None) -> None:
        """Counts a stack, from the outermost call of the project's code inwards."""
        frames = _frames(frame)
        if not frames:
            return
        self._samples += 1
        if frames in self._found or len(self._found) < MOST_KEPT:
            self._found[frames] += 1


def _frames(frame: FrameType | None) -> tuple[str, ...]:
    found: list[str] = []
    outermost = 0
    while frame is not None:
        code = frame.f_code
        found.append(f"{code.co_qualname} ({_short(code.co_filename)}:{frame.f_lineno})"[:LONGEST_FRAME])
        if is_action_file(code.co_filename):
            outermost = len(found)
        frame = frame.f_back
    return tuple(found[:outermost][::-1][:MOST_FRAMES])


def _short(name: str) -> str:
    """Returns the name of a file without the folder of its library."""
    for folder in ("site-packages/", "python3.11/"):
        if folder in name:
            return name.rpartition(folder)[2]
    return name
