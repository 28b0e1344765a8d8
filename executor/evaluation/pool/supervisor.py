"""The supervisor: gives seeds to workers, replaces workers that are lost, and returns outcomes as they come.

A worker that is lost takes its seed along; the seed is repeated, at most three times, then it is `lost`.
"""

from __future__ import annotations

import contextlib
import os
import selectors
import signal
import socket
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.evaluation.outcome import LOST, Outcome
from executor.evaluation.pool.worker import MEMORY_BYTES, Done, Job, Limits, read_done, work
from executor.supervision.confine import adopt_orphans
from executor.supervision.descendants import descendants

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    Cell = Callable[[int], Outcome]

MOST_TRIES: Final = 3
LEAST_LIMIT_S: Final = 30.0
LIMIT_FACTOR: Final = 10.0
POLL_S: Final = 0.2


@dataclass
class _Worker:
    pid: int
    channel: socket.socket
    seed: int | None = None
    held: bytearray = field(default_factory=bytearray)


class Supervisor:
    """Runs seeds with some workers; use it as a context manager, in a process with one thread.

    Args:
        cell: runs one seed in its own process.
        workers: the number of workers.
        first_limit_s: the limit of processor time of the first run, whose cost is not known yet.
        scale: the factor on the cost of the first run, for a run that takes the whole time.
        memory_bytes: the limit of memory of a process of a run.
    """

    def __init__(  # noqa: PLR0913 - a pool, and its limits
        self,
        cell: Cell,
        workers: int,
        *,
        first_limit_s: float,
        scale: Callable[[Outcome], float] = lambda _: 1.0,
        least_limit_s: float = LEAST_LIMIT_S,
        memory_bytes: int = MEMORY_BYTES,
    ) -> None:
        self._cell = cell
        self._count = workers
        self._limits = Limits(first_limit_s, memory_bytes)
        self._least_s = least_limit_s
        self._scale = scale
        self._workers: list[_Worker] = []
        self._waiting: list[int] = []
        self._tries: dict[int, int] = {}
        self._selector = selectors.DefaultSelector()

    def __enter__(self) -> Supervisor:
        adopt_orphans()
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    @property
    def pids(self) -> list[int]:
        """The process ids of the workers."""
        return [worker.pid for worker in self._workers]

    @property
    def limits(self) -> Limits:
        """The limits of the next run."""
        return self._limits

    def run(
        self, seeds: Iterable[int], told: Callable[[Done], bool], *, limits: Limits | None = None
    ) -> None:
        """Runs seeds, in their order as far as several workers keep it.

        The first one runs alone: its cost gives the limit of all others, unless it is known.

        Args:
            seeds: the seeds.
            told: called with each run that has ended; returns whether the others are still wanted.
            limits: the limits of each run, if they are known.
        """
        left = list(seeds)
        if limits is not None:
            self._limits = limits
            if not self._run_some(left, self._count, told):
                self.close()
            return
        wanted = self._run_some(left[:1], 1, self._first(told)) and self._run_some(
            left[1:], self._count, told
        )
        if not wanted:
            self.close()

    def close(self) -> None:
        """Ends all workers, and with them their runs."""
        while self._workers:
            worker = self._workers.pop()
            with contextlib.suppress(ProcessLookupError):
                os.kill(worker.pid, signal.SIGKILL)
            self._bury(worker)

    def _first(self, told: Callable[[Done], bool]) -> Callable[[Done], bool]:
        def hear(done: Done) -> bool:
            cost_s = min(done.cpu_s * self._scale(done.outcome), self._limits.cpu_s)
            limit_s = max(self._least_s, LIMIT_FACTOR * cost_s)
            self._limits = Limits(limit_s, self._limits.memory_bytes)
            return told(done)

        return hear

    def _run_some(self, seeds: list[int], workers: int, told: Callable[[Done], bool]) -> bool:
        """Runs seeds with so many workers; returns whether further runs are wanted."""
        self._waiting = list(reversed(seeds))
        while len(self._workers) < min(workers, len(seeds)):
            self._start()
        for worker in self._workers:
            self._give(worker)
        while any(worker.seed is not None for worker in self._workers):
            for key, _ in self._selector.select(POLL_S):
                for done in self._hear(key.data):
                    if not told(done):
                        return False
        return True

    def _hear(self, worker: _Worker) -> list[Done]:
        """Returns the runs that a worker reports, and gives it the next seed."""
        try:
            piece = worker.channel.recv(1 << 16)
        except ConnectionError:
            piece = b""
        if not piece:
            return self._replace(worker)
        worker.held += piece
        if not worker.held.endswith(b"\n"):
            return []
        try:
            done = read_done(bytes(worker.held))
        except (ValueError, TypeError):  # it was overwritten by what it runs
            with contextlib.suppress(ProcessLookupError):
                os.kill(worker.pid, signal.SIGKILL)
            return self._replace(worker)
        worker.held.clear()
        worker.seed = None
        self._give(worker)
        return [done]

    def _replace(self, lost: _Worker) -> list[Done]:
        """Starts a worker in place of one that is lost; its seed is repeated, at most three times."""
        seed = lost.seed
        self._workers.remove(lost)
        self._bury(lost)
        self._start()
        found: list[Done] = []
        if seed is not None:
            self._tries[seed] = self._tries.get(seed, 0) + 1
            if self._tries[seed] < MOST_TRIES:
                self._waiting.append(seed)
            else:
                why = f"its worker was lost {MOST_TRIES} times"
                found.append(Done(Outcome(seed, LOST, why), 0.0, 0.0, 0))
        self._give(self._workers[-1])
        return found

    def _give(self, worker: _Worker) -> None:
        if worker.seed is None and self._waiting:
            worker.seed = self._waiting.pop()
            with contextlib.suppress(OSError):  # its end is heard next
                worker.channel.sendall(Job(worker.seed, self._limits).to_line())

    def _start(self) -> None:
        ours, its = socket.socketpair()
        sys.stdout.flush()
        sys.stderr.flush()
        pid = os.fork()
        if pid == 0:
            status = 1
            try:
                self._close_inherited(ours)
                work(its, self._cell)
                status = 0
            finally:
                os._exit(status)
        its.close()
        worker = _Worker(pid, ours)
        self._selector.register(ours, selectors.EVENT_READ, worker)
        self._workers.append(worker)

    def _close_inherited(self, ours: socket.socket) -> None:
        self._selector.close()
        ours.close()
        for worker in self._workers:
            worker.channel.close()

    def _bury(self, worker: _Worker) -> None:
        with contextlib.suppress(KeyError, ValueError):
            self._selector.unregister(worker.channel)
        worker.channel.close()
        with contextlib.suppress(ChildProcessError):
            os.waitpid(worker.pid, 0)
        self._end_orphans()

    def _end_orphans(self) -> None:
        """Ends the processes that a lost worker has left."""
        ours = {pid for worker in self._workers for pid in (worker.pid, *descendants(worker.pid))}
        for pid in set(descendants(os.getpid())) - ours:
            with contextlib.suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
            with contextlib.suppress(ChildProcessError):
                os.waitpid(pid, 0)


def threads_of_this_process() -> int:
    """Returns the number of threads; only a process with one can be forked without harm."""
    return sum(1 for _ in Path("/proc/self/task").iterdir())
