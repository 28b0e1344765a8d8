"""Keeps an action that forks in a loop from taking the machine down before it is noticed."""

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
    """Refuses `os.fork` once this process and those forked from it did it too often in a short time.

    Who asks again while it is refused prolongs the refusal: on a machine so busy that the forked take long to
    end, each of them would else get another share, and there would be ever more of them.

    It is a guard against accidents; the manager counts the processes and ends a tree that has too many. It
    stays for the life of the process; again is harmless.
    """
    if _limited:
        return
    _limited.append(True)
    shared = mmap.mmap(-1, mmap.PAGESIZE)  # anonymous and shared: forked processes count on

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
