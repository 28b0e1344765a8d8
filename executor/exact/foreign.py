"""Finds what keeps an exact run from being copied: a fork has only the thread that forks."""

from __future__ import annotations

import os
import socket
import stat
import sys
import threading
from pathlib import Path
from typing import Final

__all__ = ["Foreign", "Threads"]

_TASKS: Final = Path("/proc/self/task")
_MIDDLEWARE: Final = "dds."
"""The begin of the names of the threads of Fast DDS; messages within a process do not need them."""
_SOFTWARE: Final = ("llvmpipe", "swrast", "softpipe", "tiny")


class Foreign:
    """Knows the threads and connections of the process before it loads the code of users."""

    def __init__(self) -> None:
        self._threads = _tasks()
        self._sockets = _connections()

    def refusal(self, renderer: str) -> str:
        """Returns why the process cannot be copied now, as the end of a sentence; "" if it can.

        Args:
            renderer: the name of the renderer that is in use; "" for none.
        """
        if "debugpy" in sys.modules:
            return "the Python debugger is connected"
        if renderer and not any(name in renderer.lower() for name in _SOFTWARE):
            return f"its pictures are drawn by {renderer}, which a copy cannot use"
        if (thread := self._foreign_thread()) is not None:
            return f"the thread {thread} runs in it"
        if _connections() - self._sockets:
            return "it holds a network connection"
        return ""

    def _foreign_thread(self) -> str | None:
        own = {thread.native_id for thread in threading.enumerate() if is_own(thread)}
        own.add(os.getpid())  # after a fork Python still has the main thread's old id
        named = {thread.native_id: thread for thread in threading.enumerate()}
        for task in _tasks() - self._threads - own:
            if (thread := named.get(task)) is not None:
                target = getattr(thread, "_target", None)
                module = getattr(target, "__module__", "") or type(thread).__module__
                return f"“{thread.name}” of the module {module}"
            name = _name_of(task)
            if name and not name.startswith(_MIDDLEWARE):
                return f"“{name}” of a library"
        return None


class Threads:
    """Checks that the threads which a copy does not have wait meanwhile, so that they hold no lock."""

    def __init__(self) -> None:
        self._before = _switches()

    @property
    def are_at_rest(self) -> bool:
        """Whether all of them waited."""
        return all(state == "S" for state, _ in self._before.values())

    def have_waited(self) -> bool:
        """Returns whether none of them has run since."""
        return _switches() == self._before


def is_own(thread: threading.Thread) -> bool:
    """Returns whether a thread is one of BT Studio, which a copy starts again."""
    return thread is threading.main_thread() or bool(getattr(thread, "is_pydev_daemon_thread", False))


def _tasks() -> set[int]:
    return {int(task.name) for task in _TASKS.iterdir()}


def _name_of(task: int) -> str:
    try:
        return (_TASKS / str(task) / "comm").read_text().strip()
    except OSError:
        return ""  # it has ended


def _connections() -> set[int]:
    """Returns the inodes of connections over the Internet's protocols."""
    found = set()
    for name in [path.name for path in Path("/proc/self/fd").iterdir()]:
        try:
            status = os.fstat(int(name))
            if not stat.S_ISSOCK(status.st_mode):
                continue
            with socket.socket(fileno=os.dup(int(name))) as one:
                if one.family != socket.AF_UNIX and one.type == socket.SOCK_STREAM:
                    found.add(status.st_ino)
        except OSError:
            continue
    return found


def _switches() -> dict[int, tuple[str, int]]:
    """Returns state and number of waits of each thread that is not Python's own."""
    python = {thread.native_id for thread in threading.enumerate()} | {os.getpid()}
    found = {}
    for task in _tasks() - python:
        try:
            text = (_TASKS / str(task) / "status").read_text()
        except OSError:
            continue
        fields = dict(line.split(":", 1) for line in text.splitlines() if ":" in line)
        switches = int(fields["voluntary_ctxt_switches"]) + int(fields["nonvoluntary_ctxt_switches"])
        found[task] = (fields["State"].split()[0], switches)
    return found
