"""The pool: a thread for each worker process, a fair queue before them, and a cache of results by content."""

from __future__ import annotations

import atexit
import hashlib
import logging
import os
import signal
import socket
import subprocess
import sys
import threading
import time
from collections import OrderedDict
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, Final

import msgspec
from cachetools import LRUCache

from backend.config.environment import REPOSITORY
from backend.core.processes.fair import FairQueue, QueueFullError
from backend.core.processes.memory import ANSWERS_MIB, MEBIBYTE
from backend.workers import frames
from backend.workers.errors import BusyError, TookTooLongError, WorkFailedError

log = logging.getLogger(__name__)

KEPT_BYTES: Final = ANSWERS_MIB * MEBIBYTE // 2
"""Bytes of results that each of the two pools keeps."""
LARGEST_KEPT_BYTES: Final = 8 << 20
MOST_TOO_LONG: Final = 1000
ATTEMPTS: Final = 2
ENDING_S: Final = 1.0
"""How long a process may take to end after its connection has ended."""
CRASHES: Final = {signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGILL, signal.SIGFPE, signal.SIGTRAP}
"""Signals by which the work itself ends its process; a library may crash where memory is short."""
SMALLER: Final = "Make the project smaller: split it, or remove what it does not need."


@dataclass(frozen=True)
class Limits:
    """The limits of a pool.

    Attributes:
        workers: the number of processes; each is started when it is first needed.
        per_owner: the number of jobs of one owner that may be in progress at the same time.
        waiting: the number of jobs of all owners that may wait.
        deadline_s: seconds that one job may take.
        memory_bytes: bytes that one worker may allocate.
        niceness: the niceness of the processes, as for `nice`.
        too_long_kept_s: seconds for which an equal job is refused after one that took too long.
    """

    workers: int
    per_owner: int
    waiting: int
    deadline_s: float
    memory_bytes: int
    niceness: int = 0
    too_long_kept_s: float = 0.0


@dataclass(frozen=True)
class _Job:
    key: bytes
    packed: bytes
    future: Future[Any]


class Pool:
    """Runs jobs in worker processes; its methods are thread-safe."""

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._changed = threading.Condition()
        self._queue: FairQueue[_Job] = FairQueue(room=limits.waiting, per_owner=limits.per_owner)
        self._going: dict[bytes, Future[Any]] = {}
        self._kept: LRUCache[bytes, bytes] = LRUCache(KEPT_BYTES, getsizeof=len)
        self._too_long: OrderedDict[bytes, float] = OrderedDict()
        self._workers: list[_Worker] = []
        self._idle = 0
        self._is_closed = False
        atexit.register(self.close)

    @property
    def waiting(self) -> int:
        """The number of jobs that wait for a worker."""
        with self._changed:
            return len(self._queue)

    def ask(self, owner: str, job: str, **arguments: Any) -> Future[Any]:
        """Passes a job to a worker; equal jobs run once, and all callers receive the result.

        Args:
            owner: the user of the job; owners take turns.
            job: a name of `jobs.JOBS`.
            arguments: the arguments of the job: text, numbers, bytes, and lists and dicts of these.

        Returns:
            a future of the result; it may raise `TookTooLongError` or `WorkFailedError`.

        Raises:
            BusyError: too many jobs wait.
        """
        return self.ask_packed(owner, packed_job(job, arguments))

    def ask_packed(self, owner: str, packed: bytes) -> Future[Any]:
        """Passes a job that `packed_job` made to a worker, like `ask`."""
        key = hashlib.sha256(packed).digest()
        future: Future[Any] = Future()
        with self._changed:
            if (kept := self._kept.get(key)) is not None:
                future.set_result(msgspec.msgpack.decode(kept)["result"])
                return future
            if time.monotonic() - self._too_long.get(key, float("-inf")) < self._limits.too_long_kept_s:
                # An equal job just took too long, so this one would, too.
                future.set_exception(_too_long(self._limits))
                return future
            if (going := self._going.get(key)) is not None:
                return going
            try:
                self._queue.put(owner, _Job(key, packed, future))
            except QueueFullError:
                raise BusyError(
                    "The server has too much to translate and check at the moment.",
                    hint="Try again in a few seconds.",
                ) from None
            self._going[key] = future
            # One process more than needed is started, so that the next job need not wait for its start.
            if self._idle < 2 and len(self._workers) < self._limits.workers:
                self._workers.append(_Worker(self, f"worker_{len(self._workers)}"))
            self._changed.notify()
        return future

    def close(self) -> None:
        """Ends all workers; jobs that wait or are in progress fail."""
        with self._changed:
            self._is_closed = True
            workers, self._workers = self._workers, []
            self._changed.notify_all()
        for worker in workers:
            worker.kill()
        for worker in workers:
            worker.thread.join()
        while (taken := self._queue.take()) is not None:
            taken[1].future.set_exception(_stops())
        atexit.unregister(self.close)

    def next(self) -> tuple[str, _Job] | None:
        """Waits for the next job, and returns it with its owner; None when the pool is closed."""
        with self._changed:
            self._idle += 1
            try:
                while not self._is_closed:
                    if (taken := self._queue.take()) is not None:
                        return taken
                    self._changed.wait()
                return None
            finally:
                self._idle -= 1

    def done(self, owner: str, job: _Job, answer: bytearray | Exception) -> None:
        """Passes the result of a job to all callers, and releases the place of its owner."""
        result, error = _opened(answer)
        with self._changed:
            self._queue.done(owner)
            self._going.pop(job.key, None)
            if error is None and isinstance(answer, bytearray) and len(answer) <= LARGEST_KEPT_BYTES:
                self._kept[job.key] = bytes(answer)
            if isinstance(error, TookTooLongError):
                self._too_long[job.key] = time.monotonic()
                while len(self._too_long) > MOST_TOO_LONG:
                    self._too_long.popitem(last=False)
            self._changed.notify()  # another job of this owner may begin
        if error is None:
            job.future.set_result(result)
        else:
            job.future.set_exception(error)

    @property
    def limits(self) -> Limits:
        """The limits of this pool."""
        return self._limits

    @property
    def is_closed(self) -> bool:
        """Whether the pool is closed."""
        return self._is_closed


def _stops() -> BusyError:
    return BusyError("The server stops.", hint="Try again in a few seconds.")


def _too_long(limits: Limits) -> TookTooLongError:
    return TookTooLongError(f"The work took more than {limits.deadline_s:g} s and was ended.", hint=SMALLER)


def _opened(answer: bytearray | Exception) -> tuple[Any, Exception | None]:
    if isinstance(answer, Exception):
        return None, answer
    try:
        message = msgspec.msgpack.decode(answer)
    except msgspec.DecodeError:
        return None, WorkFailedError("The worker ended unexpectedly.", hint=SMALLER)
    if "error" in message:
        log.error("a job failed\n%s", message["error"])
        return None, WorkFailedError(
            "The work could not be done; this is a fault of BT Studio.",
            hint="The server's log has the details.",
        )
    return message["result"], None


class _Worker:
    """A thread that passes jobs to one process, and starts another process if it ends."""

    def __init__(self, pool: Pool, name: str) -> None:
        self._pool = pool
        self._process: subprocess.Popen[bytes] | None = None
        self._connection: socket.socket | None = None
        self.thread = threading.Thread(target=self._work, name=name, daemon=True)
        self.thread.start()

    def kill(self) -> None:
        """Kills the worker process."""
        process = self._process
        if process is not None:
            with suppress(ProcessLookupError):
                process.kill()

    def _work(self) -> None:
        while (taken := self._next()) is not None:
            owner, job = taken
            answer: bytearray | Exception
            try:
                answer = self._done(job)
            except Exception as error:  # the waiting caller must get every error
                answer = error
            self._pool.done(owner, job, answer)
            del taken, job, answer  # nothing of a job stays with a thread that waits
        self.kill()
        self._end()

    def _next(self) -> tuple[str, _Job] | None:
        """Returns the next job, or None at the end.

        The process is started before, since a start takes a second.
        """
        with suppress(OSError):  # the job's own attempt reports it
            self._connected(self._pool.limits)
        return self._pool.next()

    def _done(self, job: _Job) -> bytearray:
        """Does a job, which changes nothing: if its process is ended from outside, another one does it."""
        limits = self._pool.limits
        for _ in range(ATTEMPTS):
            try:
                return self._tried(job, limits)
            except TimeoutError:
                self.kill()
                self._end()
                raise _too_long(limits) from None
            except frames.FrameError:
                code = self._end()
                log.warning("a worker %s", _ending(code))
                if (error := _by_job(code, limits)) is not None:
                    raise error from None
                if self._pool.is_closed:
                    raise _stops() from None
        raise BusyError(
            "The processes that did the work were ended from outside.", hint="Try again in a few seconds."
        )

    def _tried(self, job: _Job, limits: Limits) -> bytearray:
        connection = self._connected(limits)
        connection.settimeout(limits.deadline_s)
        frames.send(connection, job.packed)
        return frames.receive(connection)

    def _connected(self, limits: Limits) -> socket.socket:
        if self._connection is not None and self._process is not None:
            if self._process.poll() is None:
                return self._connection
            log.warning("a worker without work %s", _ending(self._end()))
        ours, theirs = socket.socketpair()
        with theirs:
            self._process = subprocess.Popen(
                [
                    *(sys.executable, "-m", "backend.workers.worker"),
                    *("--fd", str(theirs.fileno())),
                    *("--memory-bytes", str(limits.memory_bytes)),
                    *("--deadline-s", str(limits.deadline_s)),
                    *("--niceness", str(limits.niceness)),
                ],
                cwd=REPOSITORY,
                env=_ENVIRONMENT,
                pass_fds=[theirs.fileno()],
                stdin=subprocess.DEVNULL,
                start_new_session=True,
            )
        self._connection = ours
        return ours

    def _end(self) -> int | None:
        """Ends the process; returns its exit code, or None if it did not end by itself."""
        connection, self._connection = self._connection, None
        process, self._process = self._process, None
        if connection is not None:
            connection.close()
        if process is None:
            return None
        with suppress(subprocess.TimeoutExpired):
            return process.wait(ENDING_S)
        process.kill()
        process.wait()
        return None


def _ending(code: int | None) -> str:
    if code is None:
        return "was ended"
    return f"was killed by {signal.Signals(-code).name}" if code < 0 else f"ended with exit code {code}"


def _by_job(code: int | None, limits: Limits) -> Exception | None:
    """Returns the error of a job that has ended its process itself; None if something else ended it."""
    if code == frames.OUT_OF_MEMORY:
        most = limits.memory_bytes >> 20
        return WorkFailedError(
            f"The work needed more than a worker may use: {most} MB of memory.", hint=SMALLER
        )
    if code == -signal.SIGALRM:
        return _too_long(limits)
    if code is None or -code in CRASHES:
        return WorkFailedError("The work made the process crash that did it.", hint=SMALLER)
    return None


# A worker reads users' files, so its environment has only what Python needs, and no secret of the server.
_ENVIRONMENT: Final = {
    name: os.environ[name] for name in ("PATH", "LANG", "LC_ALL", "PYTHONPATH") if name in os.environ
}


def packed_job(job: str, arguments: dict[str, Any]) -> bytes:
    """Returns a job in the form that workers read."""
    return frames.pack({"job": job, "arguments": arguments})
