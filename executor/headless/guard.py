"""Ends a run in this process if it hangs, and reports where: `with Guard() as guard`.

A thread detects that the run makes no progress, and interrupts the main thread. Code that holds Python's
interpreter lock also stops this thread; for that case a separate process waits for the beats of the thread.
"""

from __future__ import annotations

import asyncio
import ctypes
import faulthandler
import os
import select
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, Final

from executor.session.hangs.vitals import (
    BUSY_SHARE,
    END_AFTER_S,
    LOADING_S,
    LONGEST_GAP_S,
    MOST_FORGIVEN,
    STOPPED,
    TRACED,
)
from executor.session.trace import action_frame
from executor.supervision.confine import INTERRUPT_SIGNAL, TRACE_SIGNAL
from executor.supervision.pulse import NOTES_BYTES
from executor.supervision.signs import Notes, look_at

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

__all__ = ["Guard", "Hung"]

BEAT: Final = b"."
END: Final = b"e"
"""The last message: a process that an action forked may hold the pipe open for longer than the run."""
BEAT_S: Final = 0.25
STUBBORN_S: Final = 2.0
GOODBYE_S: Final = 1.0
END_SIGNAL: Final = signal.SIGHUP
"""The signal that ends this process; its number, 1, becomes the exit status."""
_ACTIONS: Final = "actions/"
_ENGINE: Final = "tree_gardener/"


class Hung(BaseException):
    """Raised in a main thread that hangs. It is not an `Exception`, since actions may catch those.

    The text begins with file, line and column.
    """


def sentence(file: str, line: int, what: str, for_s: float) -> str:
    """Returns the error in the format of the command line."""
    return f"{file}:{line}:1: timeout {what} has not returned for {for_s:.0f} s, and was interrupted"


class Guard:
    """Watches this process during a run; use it as a context manager on the main thread."""

    def __init__(self) -> None:
        self._main = threading.main_thread().ident or 0
        self._moves = 0
        self._is_suspended = False
        self._text = ""
        self._is_over = threading.Event()
        self._thread = threading.Thread(target=self._watch, name="guard", daemon=True)

    def __enter__(self) -> Guard:
        self._before = signal.signal(INTERRUPT_SIGNAL, self._break)
        notes = Notes()
        os.lseek(notes.fd, NOTES_BYTES, os.SEEK_SET)
        faulthandler.register(TRACE_SIGNAL, file=notes.fd, all_threads=True)
        libc: Any = ctypes.CDLL(None)
        libc.signal(int(END_SIGNAL), ctypes.cast(libc._exit, ctypes.c_void_p))
        self._process = subprocess.Popen(
            [sys.executable, "-m", "executor.headless.guard", str(os.getpid()), str(notes.fd)],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            pass_fds=[notes.fd],
        )
        self._notes = notes
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._is_over.set()
        self._thread.join()
        assert self._process.stdin is not None  # noqa: S101 - it was asked for
        self._say(END)
        with suppress(OSError):
            self._process.stdin.close()
        self._process.wait()
        faulthandler.unregister(TRACE_SIGNAL)
        self._notes.close()
        signal.signal(INTERRUPT_SIGNAL, self._before)

    def moved(self) -> None:
        """Notes that the run made progress."""
        self._moves += 1

    @contextmanager
    def suspended(self) -> Iterator[None]:
        """Does not count the time meanwhile: the main thread waits for a user, not for users' code."""
        self._is_suspended = True
        try:
            yield
        finally:
            self._moves += 1
            self._is_suspended = False

    def _break(self, _number: int, frame: FrameType | None) -> None:
        if self._text and not self._is_over.is_set() and _user_frame(frame) is not None:
            text, self._text = self._text, ""
            self._moves += 1
            raise Hung(text)

    def _watch(self) -> None:
        moves, idle_s, stuck_s = -1, 0.0, 0.0
        clock = time.pthread_getcpuclockid(self._main)
        before_s, ran_s = time.monotonic(), time.clock_gettime(clock)
        while not self._is_over.wait(BEAT_S):
            self._say(BEAT)
            now_s, cpu_s = time.monotonic(), time.clock_gettime(clock)
            gap_s = min(now_s - before_s, LONGEST_GAP_S)
            is_at_work = cpu_s - ran_s >= BUSY_SHARE * gap_s
            before_s, ran_s = now_s, cpu_s
            if self._moves != moves or self._is_suspended:
                moves, idle_s, stuck_s = self._moves, 0.0, 0.0
                continue
            stuck_s += gap_s
            idle_s = 0.0 if is_at_work else idle_s + gap_s
            if idle_s >= END_AFTER_S or stuck_s >= LOADING_S:
                self._end(stuck_s)

    def _say(self, what: bytes) -> None:
        assert self._process.stdin is not None  # noqa: S101 - it was asked for
        with suppress(OSError):  # without the process the guard still has its thread
            self._process.stdin.write(what)
            self._process.stdin.flush()

    def _end(self, for_s: float) -> None:
        """Interrupts the main thread, and ends the process if the interrupt has no effect."""
        frame = _user_frame(sys._current_frames().get(self._main))
        if frame is None:
            return  # our own code runs at the moment, and will return
        moves, text = self._moves, _describe(frame, for_s)
        self._text = text
        signal.pthread_kill(self._main, INTERRUPT_SIGNAL)
        self._is_over.wait(STUBBORN_S)
        again = _user_frame(sys._current_frames().get(self._main))
        if again is not None and again.f_code is frame.f_code and self._moves <= moves + 1:
            sys.stderr.write(f"{text}\n")
            sys.stderr.flush()
            os._exit(1)


def _user_frame(frame: FrameType | None) -> FrameType | None:
    while frame is not None and not frame.f_code.co_filename.startswith(_ACTIONS):
        frame = frame.f_back
    return frame


def _describe(frame: FrameType, for_s: float) -> str:
    file, line = frame.f_code.co_filename, frame.f_lineno
    node = _node_of(frame)
    what = f"{node.type} '{node.path}'" if node is not None else _by_file(file)
    return sentence(file, line, what, for_s)


def _by_file(file: str) -> str:
    return file.removeprefix(_ACTIONS).removesuffix(".py")


def _node_of(frame: FrameType | None) -> Any:
    """Returns the node whose action is on the stack, found by the engine's frames."""
    while frame is not None:
        if _ENGINE in frame.f_code.co_filename:
            node = frame.f_locals.get("leaf") or frame.f_locals.get("self")
            if getattr(node, "instance_behaviour", None) is not None:
                return node
        frame = frame.f_back
    return None


def listen(pid: int, notes: Notes, beats: int) -> None:
    """Waits for the beats of a run, in a separate process; ends the run's process if they stop."""
    silent_s, before, before_s = 0.0, look_at(pid), time.monotonic()
    while silent_s < END_AFTER_S:
        ready, _, _ = select.select([beats], [], [], BEAT_S)
        signs = look_at(pid)
        said = os.read(beats, 4096) if ready else BEAT
        if signs is None or before is None or not said or END in said:
            return
        now_s = time.monotonic()
        waited_s = signs.waited_s - before.waited_s
        gap_s = min(now_s - before_s, LONGEST_GAP_S)
        counted_s = gap_s - min(waited_s, MOST_FORGIVEN * gap_s)
        before, before_s = signs, now_s
        silent_s = 0.0 if ready or signs.state in {STOPPED, TRACED} else silent_s + counted_s
    frame = action_frame(asyncio.run(notes.trace(pid)))
    file, line, what = (
        ("tree", 1, "the run") if frame is None else (frame.file, frame.line, _by_file(frame.file))
    )
    text = sentence(file, line, what, silent_s)
    sys.stderr.write(f"{text}: it lets no other Python code run\n")
    sys.stderr.flush()
    for number in (END_SIGNAL, signal.SIGKILL):
        with suppress(ProcessLookupError):
            os.kill(pid, number)
        time.sleep(GOODBYE_S)


def main() -> None:
    """Guards another process; its id and its notes file are the arguments."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the run
    pid, fd = map(int, sys.argv[1:])
    listen(pid, Notes(fd), sys.stdin.fileno())


if __name__ == "__main__":
    main()
