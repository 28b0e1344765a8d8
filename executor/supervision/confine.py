"""What a child process of the manager does first: make sure that it cannot outlive the manager."""

from __future__ import annotations

import ctypes
import os
import signal
from typing import Final

__all__ = ["INTERRUPT_SIGNAL", "PARENT_VARIABLE", "TRACE_SIGNAL", "adopt_orphans", "die_with_parent"]

INTERRUPT_SIGNAL: Final = signal.SIGUSR1
TRACE_SIGNAL: Final = signal.SIGUSR2
PARENT_VARIABLE: Final = "BT_STUDIO_PARENT_PID"
_PR_SET_PDEATHSIG: Final = 1
_PR_SET_CHILD_SUBREAPER: Final = 36


def _prctl(option: int, value: int) -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(option, ctypes.c_ulong(value), 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl failed")


def die_with_parent() -> None:
    """Has this process, and what it forks from Python, killed when its parent ends.

    The parent's id comes in the environment: a parent that ended before we asked is noticed.
    """
    _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    expected = os.environ.pop(PARENT_VARIABLE, "")
    if expected and os.getppid() != int(expected):
        os._exit(1)
    # The setting is lost in a fork.
    os.register_at_fork(after_in_child=lambda: _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL))


def adopt_orphans() -> None:
    """Makes this process the parent of descendants whose own parent ends, so that it can end them."""
    _prctl(_PR_SET_CHILD_SUBREAPER, 1)
