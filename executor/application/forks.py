"""Limits how often actions may fork, so that an action that forks in a loop does not exhaust the machine."""

from __future__ import annotations

import errno
import mmap
import struct
import sys
import time
from typing import Any, Final

__all__ = ["limit_forks"]

FORKS: Final = 64
WINDOW_S: Final = 2.0
_STATE: Final = struct.Struct("dq")
_limited: Final[list[bool]] = []


def limit_forks() -> None:
    """Makes `os.fork` fail after this process and its forks have called it too often in a short time.

    A refused call prolongs the refusal: on a busy machine, forked processes take long to end; without this
    rule each of them could fork again, and their number would grow.

    The limit guards against accidents; the manager also counts the processes, and ends a process tree with
    too many. The limit lasts for the life of the process. The function may be called twice.
    """
    if _limited:
        return
    _limited.append(True)
    shared = mmap.mmap(-1, mmap.PAGESIZE)  # anonymous and shared: forked processes count in it too

    def audit(event: str, _: tuple[Any, ...]) -> None:
        if event != "os.fork":
            return
        start_s, count = _STATE.unpack_from(shared)
        now_s = time.monotonic()
        if now_s > start_s + WINDOW_S:
            start_s, count = now_s, 0
        _STATE.pack_into(shared, 0, start_s, count + 1)
        if count >= FORKS:
            _STATE.pack_into(shared, 0, now_s, count)
            raise BlockingIOError(errno.EAGAIN, f"more than {FORKS} forks in {WINDOW_S:g} s")

    sys.addaudithook(audit)
