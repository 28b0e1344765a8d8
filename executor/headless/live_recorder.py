"""Records a run in real time by the events and frames of its session."""

from __future__ import annotations

import sys
import time
from typing import TYPE_CHECKING, Any, Self

import msgspec

from executor import messages
from executor.recorder.events import EventRecorder

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.headless.recording import Recording

__all__ = ["LiveRecorder"]


class LiveRecorder:
    """Writes a session into a recording; a context manager that completes the file.

    Args:
        recording: the open recording.
        clock: returns the time in s that decides when all is written to disk, once a second.
    """

    def __init__(self, recording: Recording, clock: Callable[[], float] = time.monotonic) -> None:
        self._recording = recording
        self._recorder = EventRecorder(recording.writer)
        self._clock = clock
        self._is_stopped = False

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        try:
            self._recording.close()
        except OSError as error:
            self._stop(error)

    def event(self, message: dict[str, Any]) -> None:
        """Writes an event of the control socket."""
        tick = message.get("tick") or 0
        self._guarded(
            lambda: self._recorder.event(message["command"], message["t"], tick, message["data"]),
        )

    def frame(self, frame: object, data: bytes) -> None:
        """Writes a frame of the stream socket, decoded and as it came."""
        match frame:
            case messages.Scene() | messages.Poses():
                stream = "scene" if isinstance(frame, messages.Scene) else "poses"
                self._guarded(lambda: self._recorder.frame(stream, frame.t, data))
            case messages.Scan():
                self._guarded(lambda: self._recorder.scan(msgspec.structs.asdict(frame)))
            case _:
                pass

    def _guarded(self, write: Callable[[], object]) -> None:
        """Writes; if that fails, the recording stops there, and the run continues."""
        if self._is_stopped:
            return
        try:
            write()
            self._recorder.flush_due(self._clock())
        except OSError as error:
            self._stop(error)

    def _stop(self, error: OSError) -> None:
        if not self._is_stopped:
            sys.stderr.write(f"{self._recording.path}: the recording stops here: {error.strerror}\n")
        self._is_stopped = True
