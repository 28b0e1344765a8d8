"""A worker: forks a process for each run, so that a run that dies is that run's outcome and nothing more.

The worker is a copy of one loaded parent: it has one thread, and neither a context of ROS, a physics server,
a picture context nor a module of the user. What a run does to itself, it does to its own process.
"""

from __future__ import annotations

import contextlib
import faulthandler
import json
import os
import re
import resource
import select
import signal
import tempfile
import time
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.evaluation.outcome import CRASHED, ERROR, LOST, TIMEOUT, Outcome, read_outcome
from executor.evaluation.pool.accounting import usage, written_bytes
from executor.supervision.confine import TRACE_SIGNAL, adopt_orphans
from executor.supervision.descendants import descendants
from executor.supervision.scratch import Scratch
from executor.supervision.signal_names import signal_name
from tree_gardener.descendants import end_with

if TYPE_CHECKING:
    import socket
    from collections.abc import Callable
    from pathlib import Path

    Cell = Callable[[int], Outcome]
    """Runs a seed in this process."""

POLL_S: Final = 0.05
WALL_FACTOR: Final = 10.0
MEMORY_BYTES: Final = int(os.environ.get("BT_STUDIO_EVALUATION_MEMORY_MB") or 3072) << 20
"""What one process of a run may take; containers set it by their own limit."""
MOST_BYTES: Final = 64 << 20
MOST_PROCESSES: Final = 256
MOST_WRITTEN: Final = 192 << 20
"""The most bytes in the folder of the actions of a sealed run, where no mount bounds it."""
# A busy machine needs a while for the trace. It is written in pieces, so its first bytes say nothing yet.
TRACE_S: Final = 5.0
_FRAME: Final = re.compile(rb'File "((?:actions|evaluations)/[^"\n]+)", line (\d+)')


@dataclass(frozen=True)
class Limits:
    """Bounds of one run: processor time of all its processes in s, and memory of each in bytes."""

    cpu_s: float
    memory_bytes: int = MEMORY_BYTES

    @property
    def wall_s(self) -> float:
        """The second limit: a run that takes longer says nothing of the project."""
        return self.cpu_s * WALL_FACTOR


@dataclass(frozen=True)
class Job:
    """A seed to run, within limits."""

    seed: int
    limits: Limits

    def to_line(self) -> bytes:
        """Returns the job as a line for a worker."""
        return json.dumps({"seed": self.seed, **asdict(self.limits)}).encode() + b"\n"


@dataclass(frozen=True)
class Done:
    """A run that has ended, with its cost."""

    outcome: Outcome
    cpu_s: float
    wall_s: float
    rss_bytes: int

    def to_line(self) -> bytes:
        """Returns it as a line for the supervisor."""
        costs = {"cpu_s": self.cpu_s, "wall_s": self.wall_s, "rss_bytes": self.rss_bytes}
        return json.dumps({"outcome": self.outcome.to_line(), **costs}).encode() + b"\n"


def read_done(line: bytes) -> Done:
    """Reads a line that `Done.to_line` wrote.

    Raises:
        ValueError: the line is something else.
    """
    document: Any = json.loads(line)
    return Done(read_outcome(document.pop("outcome")), **document)


def work(channel: socket.socket, cell: Cell) -> None:
    """Runs the jobs that arrive on a channel, until its other end closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the supervisor hears it, and decides
    adopt_orphans()
    with channel, channel.makefile("rb") as lines:
        for line in lines:
            document = json.loads(line)
            done = run_apart(Job(document.pop("seed"), Limits(**document)), cell, inherited=channel.fileno())
            channel.sendall(done.to_line())


def run_apart(job: Job, cell: Cell, *, inherited: int = -1) -> Done:
    """Runs a job in a fork of this process, and returns when it and all that it started have ended.

    Args:
        job: the seed and its limits.
        cell: runs the seed.
        inherited: a descriptor that the run must not have.
    """
    began_s = time.monotonic()
    scratch = Scratch()  # also removed if this process is killed
    trace = os.memfd_create("trace")
    reader, writer = os.pipe()
    parent = os.getpid()
    pid = os.fork()
    if pid == 0:
        os.close(reader)
        if inherited >= 0:
            os.close(inherited)
        end_with(parent)
        _run_child(job, cell, writer, trace, scratch.path)
    os.close(writer)
    try:
        watch = _Watch(pid, reader, trace, job, str(scratch.path))
        data, ended = watch.wait()
        outcome = _outcome_of(job.seed, data, ended or "", watch, _place_in(trace))
        return Done(outcome, round(watch.cpu_s, 3), time.monotonic() - began_s, watch.rss_bytes)
    finally:
        os.close(reader)
        os.close(trace)
        scratch.remove()


def _outcome_of(seed: int, data: bytes, ended: str, watch: _Watch, place: str) -> Outcome:
    where = f" in {place}" if place else ""
    if ended == TIMEOUT:
        file = f" in {place.partition(':')[0]}" if place else ""
        return Outcome(seed, TIMEOUT, f"the run took more than its limit of processor time{file}")
    if ended == LOST:
        return Outcome(seed, LOST, "the run took more than its limit of real time")
    if ended == CRASHED:
        return Outcome(seed, CRASHED, watch.excess)
    with contextlib.suppress(ValueError):
        found = read_outcome(data)
        if found.seed == seed:
            return found
    if os.WIFSIGNALED(watch.status):
        name = signal_name(os.WTERMSIG(watch.status))
        return Outcome(seed, CRASHED, f"the process of the run ended with {name}{where}")
    return Outcome(
        seed, CRASHED, f"the process of the run ended by itself with status {os.WEXITSTATUS(watch.status)}"
    )


class _Watch:
    """Waits for a run, reads its result, and ends it at its limits."""

    def __init__(self, pid: int, reader: int, trace: int, job: Job, folder: str) -> None:
        self._pid = pid
        self._reader = reader
        self._trace = trace
        self._limits = job.limits
        self._folder = folder
        self.excess = ""
        self.status = 0
        self.cpu_s = 0.0
        self.rss_bytes = 0

    def wait(self) -> tuple[bytes, str | None]:
        """Returns the output of the run, and the outcome if the run was stopped."""
        end_s = time.monotonic() + self._limits.wall_s
        data, ended = bytearray(), None
        poll = select.poll()
        process = os.pidfd_open(self._pid)
        try:
            poll.register(process, select.POLLIN)
            poll.register(self._reader, select.POLLIN)
            is_alive = True
            while is_alive:
                ready = dict(poll.poll(POLL_S * 1000))
                is_alive = process not in ready
                if self._reader in ready and not self._read(data):
                    poll.unregister(self._reader)
                ended = ended or self._over(end_s)
                if ended is not None or len(data) > MOST_BYTES:
                    self._end(process, trace=ended == TIMEOUT)
                    is_alive = False
        finally:
            os.close(process)
            self._bury()
        os.set_blocking(self._reader, False)
        while self._read(data):
            pass
        return bytes(data), ended

    def _read(self, data: bytearray) -> bool:
        try:
            piece = os.read(self._reader, 1 << 16)
        except BlockingIOError:
            return False
        data += piece
        return bool(piece)

    def _over(self, end_s: float) -> str | None:
        pids = descendants(os.getpid())
        used = usage(pids)
        self.cpu_s, self.rss_bytes = max(self.cpu_s, used.cpu_s), max(self.rss_bytes, used.rss_bytes)
        if used.cpu_s > self._limits.cpu_s:
            return TIMEOUT
        if used.rss_bytes > 2 * self._limits.memory_bytes:
            self.excess = "the processes of the run took more than their limit of memory"
        elif len(pids) > MOST_PROCESSES:
            self.excess = "the run started more processes than it may"
        elif written_bytes(self._folder) > MOST_WRITTEN:
            self.excess = "the actions of the run wrote more than they may"
        if self.excess:
            return CRASHED
        return LOST if time.monotonic() > end_s else None

    def _end(self, process: int, *, trace: bool) -> None:
        if trace:
            with contextlib.suppress(ProcessLookupError):
                os.kill(self._pid, TRACE_SIGNAL)
                _wait_for(lambda: bool(_place_in(self._trace)))
        with contextlib.suppress(ProcessLookupError):
            signal.pidfd_send_signal(process, signal.SIGKILL)

    def _bury(self) -> None:
        """Waits for the run, and ends all that it has left."""
        _, self.status, used = os.wait4(self._pid, 0)
        cpu_s = used.ru_utime + used.ru_stime
        self.rss_bytes = max(self.rss_bytes, used.ru_maxrss << 10)
        while left := descendants(os.getpid()):
            for pid in left:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            with contextlib.suppress(ChildProcessError):
                how = 0  # waits for one, and takes those that have ended with it
                while (ended := os.wait4(-1, how))[0]:
                    cpu_s += ended[2].ru_utime + ended[2].ru_stime
                    how = os.WNOHANG
        self.cpu_s = max(self.cpu_s, cpu_s)


def _wait_for(condition: Callable[[], bool]) -> None:
    end_s = time.monotonic() + TRACE_S
    while not condition() and time.monotonic() < end_s:
        time.sleep(0.01)


def _place_in(trace: int) -> str:
    """Returns the innermost line of the user's code in the trace of the run's main thread."""
    size = os.fstat(trace).st_size
    text = os.pread(trace, min(size, 1 << 16), 0)
    found = _FRAME.search(text)
    return f"{found[1].decode(errors='replace')}:{int(found[2])}" if found else ""


def _run_child(job: Job, cell: Cell, writer: int, trace: int, folder: Path) -> None:
    """Runs the seed, writes its outcome, and ends this process. Never returns."""
    own = os.getpid()
    try:
        _confine(job, trace, folder)
        try:
            outcome = cell(job.seed)
        except MemoryError:
            outcome = Outcome(job.seed, ERROR, "MemoryError")
        except Exception as error:
            outcome = Outcome(job.seed, ERROR, f"{type(error).__name__}: {error}")
        if os.getpid() == own:  # a fork of the user's code has come here, too
            _write(writer, outcome.to_line().encode())
            os._exit(0)
    finally:
        os._exit(1)


def _confine(job: Job, trace: int, folder: Path) -> None:
    os.setpgid(0, 0)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    null = os.open(os.devnull, os.O_RDWR)
    for target in (0, 1, 2):
        os.dup2(null, target)
    faulthandler.enable(trace)
    faulthandler.register(TRACE_SIGNAL, trace)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_DATA, (job.limits.memory_bytes,) * 2)
    tempfile.tempdir = os.environ["TMPDIR"] = str(folder)


def _write(writer: int, data: bytes) -> None:
    while data:
        data = data[os.write(writer, data) :]
