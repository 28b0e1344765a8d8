"""Continues a run under several values or seeds, each in a fork; this process stays at the moment.

A fork is the run at the moment, to the last bit: so the run is made again only once, and each continuation
does what the run itself would have done. Forks end with this process, and this process with the manager.
"""

from __future__ import annotations

import os
import random
import select
import signal
import time
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

import msgspec

from executor.child_messages import TryingEnded, TryingProgress, TryOutcome
from executor.exact.foreign import Threads
from executor.supervision.copies import renew_files
from executor.supervision.parking import PARKING
from executor.supervision.room import processors
from executor.supervision.signal_names import how_ended

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from executor.child_messages import NewSeed, SetPort

    Change = SetPort | NewSeed

__all__ = ["Trying", "most_at_once"]

PARKED_S: Final = 0.05
FORK_TRIES: Final = 100
FORK_RETRY_S: Final = 0.01
SELECT_S: Final = 0.2
SILENT_S: Final = 20.0
"""A continuation whose tick does not return for so long is ended."""
MOST_S: Final = 600.0
MOST_BYTES: Final = 4 << 20
NICE: Final = 5
_OUTCOME: Final = b"="
_decode: Final = msgspec.msgpack.Decoder(TryOutcome).decode
BUSY: Final = "Another thread of the process of this run does not rest, so that it cannot be copied."
LATE: Final = f"A tick did not return for {SILENT_S:g} s."
TOO_LONG: Final = f"It took more than {MOST_S:g} s."


def most_at_once() -> int:
    """Returns how many continuations run at the same time: a processor stays free for the session."""
    return max(1, processors() - 1)


@dataclass
class _Running:
    """A continuation that runs."""

    index: int
    pid: int
    begun_s: float
    heard_s: float
    data: bytearray = field(default_factory=bytearray)
    fraction: float = 0.0
    reason: str = ""


class Trying:
    """Runs the continuations of one job.

    Args:
        job: its name.
        changes: the changes; before them it runs once without any.
        send: sends a message to the session.
        moved: is called now and then, as a sign that this process works.
        continue_with: continues the run with a change, in a fork: takes the number of the continuation, the
            change and a function for its progress, and returns the outcome.
    """

    def __init__(
        self,
        job: str,
        changes: Sequence[Change],
        *,
        send: Callable[[TryingProgress | TryOutcome | TryingEnded], None],
        moved: Callable[[], None],
        continue_with: Callable[[int, Change | None, Callable[[float], None]], TryOutcome],
    ) -> None:
        self._job = job
        self._changes: list[Change | None] = [None, *changes]
        self._send = send
        self._moved = moved
        self._continue_with = continue_with
        self._running: dict[int, _Running] = {}
        self._done = 0

    def run(self) -> None:
        """Runs all of them, and sends their outcomes as they come."""
        waiting = list(range(len(self._changes)))
        most = most_at_once()
        while waiting or self._running:
            while waiting and len(self._running) < most:
                if not self._start(waiting.pop(0)):
                    self._kill_all()
                    self._send(TryingEnded(self._job, "failed", BUSY))
                    return
            self._listen()
            self._moved()
        self._send(TryingEnded(self._job, "complete"))

    def _start(self, index: int) -> bool:
        """Forks a continuation; returns whether that worked."""
        for _ in range(FORK_TRIES):
            if self._fork(index):
                return True
            self._moved()
            time.sleep(FORK_RETRY_S)
        return False

    def _fork(self, index: int) -> bool:
        with PARKING.parked(PARKED_S) as are_parked:
            threads = Threads()
            numbers = random.getstate()  # Python seeds its generator again in each fork
            if not are_parked or not threads.are_at_rest:
                return False
            read, write = os.pipe()
            try:
                pid = os.fork()
            except OSError:
                os.close(read)
                os.close(write)
                return False
            if not pid:
                PARKING.forget()
                random.setstate(numbers)
                os.close(read)
                self._be(index, write)
            is_good = threads.have_waited()
        os.close(write)
        if not is_good:
            os.kill(pid, signal.SIGKILL)
            os.waitpid(pid, 0)
            os.close(read)
            return False
        now_s = time.monotonic()
        self._running[read] = _Running(index, pid, now_s, now_s)
        return True

    def _be(self, index: int, write: int) -> None:
        """Is a continuation; does not return."""
        try:
            for fd in self._running:
                os.close(fd)
            os.nice(NICE)
            renew_files()

            def tell(fraction: float) -> None:
                os.write(write, bytes([min(60, int(60 * fraction))]))

            outcome = self._continue_with(index, self._changes[index], tell)
            data = _OUTCOME + msgspec.msgpack.encode(outcome)
            while data:
                data = data[os.write(write, data) :]
        except BaseException:  # whatever it is, nobody would see it
            os._exit(1)
        os._exit(0)

    def _listen(self) -> None:
        """Takes what the continuations say, and ends those that are late."""
        ready, _, _ = select.select(list(self._running), [], [], SELECT_S)
        now_s = time.monotonic()
        for fd in list(self._running):
            it = self._running[fd]
            if fd in ready:
                data = os.read(fd, 1 << 16)
                it.heard_s = now_s
                it.data += data
                if not data or len(it.data) > MOST_BYTES:
                    self._end(fd)
                    continue
                self._note(it)
            if now_s - it.heard_s > SILENT_S or now_s - it.begun_s > MOST_S:
                it.reason = LATE if now_s - it.heard_s > SILENT_S else TOO_LONG
                self._end(fd)
        self._tell()

    def _note(self, it: _Running) -> None:
        """Takes the signs of progress before the outcome."""
        while it.data and it.data[:1] != _OUTCOME:
            it.fraction = min(1.0, it.data[0] / 60)
            del it.data[0]

    def _end(self, fd: int) -> None:
        """Takes the outcome of a continuation that has ended, or has to."""
        it = self._running.pop(fd)
        os.close(fd)
        with suppress(ProcessLookupError):
            os.kill(it.pid, signal.SIGKILL)
        _, status = os.waitpid(it.pid, 0)
        self._done += 1
        self._send(self._outcome(it, status))

    def _outcome(self, it: _Running, status: int) -> TryOutcome:
        if it.reason:
            return TryOutcome(self._job, it.index, "late", it.reason)
        if it.data[:1] == _OUTCOME:
            with suppress(msgspec.MsgspecError):  # users' code runs in the process that sent it
                outcome = _decode(it.data[1:])
                outcome.job, outcome.index = self._job, it.index
                return outcome
        code = os.waitstatus_to_exitcode(status)
        return TryOutcome(self._job, it.index, "died", f"Its process {how_ended(code)}.")

    def _tell(self) -> None:
        done = self._done + sum(it.fraction for it in self._running.values())
        self._send(TryingProgress(self._job, "continuing", min(1.0, done / len(self._changes))))

    def _kill_all(self) -> None:
        for fd in list(self._running):
            it = self._running.pop(fd)
            os.close(fd)
            with suppress(ProcessLookupError):
                os.kill(it.pid, signal.SIGKILL)
            os.waitpid(it.pid, 0)
