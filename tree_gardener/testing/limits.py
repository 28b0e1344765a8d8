"""The bounds of one test: processor time and memory of the process that runs it."""

import contextlib
import pathlib
import resource
import signal
from collections.abc import Iterator
from types import FrameType
from typing import Final

PROCESSOR_S: Final = 10.0
MEMORY_BYTES: Final = 256 * 1024 * 1024
HARD_EXTRA_S: Final = 5
"""How long after the limit a process that does not react is ended."""

_STATM = pathlib.Path("/proc/self/statm")


class OverLimitError(BaseException):
    """A test needs more processor time than it may have; no action can catch it as an Exception."""


@contextlib.contextmanager
def processor_time(limit_s: float = PROCESSOR_S) -> Iterator[None]:
    """Raises OverLimitError in the main thread after so much processor time.

    A process that does not react is ended a little later.
    """

    def over(_: int, __: FrameType | None) -> None:
        raise OverLimitError

    before = signal.signal(signal.SIGPROF, over)
    used = resource.getrusage(resource.RUSAGE_SELF)
    hard = resource.getrlimit(resource.RLIMIT_CPU)[1]
    at_most = int(used.ru_utime + used.ru_stime + limit_s) + 1 + HARD_EXTRA_S
    resource.setrlimit(resource.RLIMIT_CPU, (at_most if hard < 0 else min(at_most, hard), hard))
    signal.setitimer(signal.ITIMER_PROF, limit_s)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
        resource.setrlimit(resource.RLIMIT_CPU, (hard, hard))


@contextlib.contextmanager
def memory(extra_bytes: int = MEMORY_BYTES) -> Iterator[None]:
    """Allows the process so much more memory than it has now; more is a MemoryError."""
    before, hard = resource.getrlimit(resource.RLIMIT_AS)
    try:
        held = int(_STATM.read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    except OSError:  # no Linux
        yield
        return
    wanted = held + extra_bytes
    resource.setrlimit(resource.RLIMIT_AS, (wanted if hard < 0 else min(wanted, hard), hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (before, hard))
