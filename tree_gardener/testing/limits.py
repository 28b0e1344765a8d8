"""The bounds of one test: processor time and memory of the process that runs it."""

import contextlib
import pathlib
import resource
import signal
import time
from collections.abc import Iterator
from types import FrameType
from typing import Final

PROCESSOR_S: Final = 10.0
MEMORY_BYTES: Final = 256 * 1024 * 1024
HARD_EXTRA_S: Final = 5
"""How long after the limit a process that does not react is ended."""

_LIMITED_CLOCK: Final = -8
"""The clock of the kernel for RLIMIT_CPU. It counts ticks; after minutes, getrusage differs by seconds.

The number is that of ``CPUCLOCK_PROF`` of the own process (``linux/posix-timers.h``).
"""

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
    soft, hard = resource.getrlimit(resource.RLIMIT_CPU)
    at_most = int(_used_s() + limit_s) + 1 + HARD_EXTRA_S
    resource.setrlimit(resource.RLIMIT_CPU, (at_most if hard < 0 else min(at_most, hard), hard))
    signal.setitimer(signal.ITIMER_PROF, limit_s)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)
        resource.setrlimit(resource.RLIMIT_CPU, (soft, hard))


def _used_s() -> float:
    try:
        return time.clock_gettime(_LIMITED_CLOCK)
    except OSError:  # no Linux
        return time.process_time()


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
