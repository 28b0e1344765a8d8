"""Threads of BT Studio in a process that runs users' code."""

from __future__ import annotations

import threading
from typing import TypeVar

__all__ = ["own"]

AThread = TypeVar("AThread", bound=threading.Thread)


def own(thread: AThread) -> AThread:
    """Marks a thread as one that a Python debugger neither traces nor stops; returns it.

    pydevd reads these names (`_pydevd_bundle/pydevd_daemon_thread.py`).
    """
    thread.pydev_do_not_trace = True  # type: ignore[attr-defined]
    thread.is_pydev_daemon_thread = True  # type: ignore[attr-defined]
    return thread
