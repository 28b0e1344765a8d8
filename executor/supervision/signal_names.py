"""The names of signals, and sentences about how a process has ended."""

from __future__ import annotations

import signal
from typing import Final

__all__ = ["how_ended", "signal_name"]

_CRASHES: Final = frozenset({signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGILL, signal.SIGSEGV})
"""The signals with which a fault in native code ends its process."""


def signal_name(number: int) -> str:
    """Returns the name of a signal; "signal 40" for a real-time one, which has a number alone."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def how_ended(code: int) -> str:
    """Returns how a process has ended, for users; `code` is that of `subprocess`. Logs name signals."""
    if code >= 0:
        return f"ended with exit code {code}"
    if -code == signal.SIGKILL:
        return "was ended at once, as the system does when memory runs out"
    words = signal.strsignal(-code) or signal_name(-code)
    return f"crashed: {words}" if -code in _CRASHES else f"was ended: {words}"
