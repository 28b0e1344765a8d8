"""Binds the life of a child process to that of its parent, and limits one that reads hostile files."""

from __future__ import annotations

import ctypes
import os
import resource
import signal
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from tree_gardener.descendants import adopt_orphans, end_with

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = [
    "INTERRUPT_SIGNAL",
    "PARENT_VARIABLE",
    "TRACE_SIGNAL",
    "adopt_orphans",
    "confine_reader",
    "die_with_parent",
    "forks_survive",
]

INTERRUPT_SIGNAL: Final = signal.SIGUSR1
TRACE_SIGNAL: Final = signal.SIGUSR2
PARENT_VARIABLE: Final = "BT_STUDIO_PARENT_PID"
_copying: Final[list[bool]] = []
_NEW_USER, _NEW_NET = 0x10000000, 0x40000000


def die_with_parent() -> None:
    """Makes the kernel kill this process, and its forks from Python, when its parent ends.

    If the parent ended before the call, its id in the environment shows that, and this process ends.
    """
    end_with(int(os.environ.pop(PARENT_VARIABLE, os.getppid())))
    # Forked children do not inherit the setting, so each sets it again.
    os.register_at_fork(after_in_child=_die_too)


def _die_too() -> None:
    if not _copying:
        end_with(os.getppid())


@contextmanager
def forks_survive() -> Iterator[None]:
    """Makes the processes that are forked meanwhile survive their parents."""
    _copying.append(True)
    try:
        yield
    finally:
        _copying.pop()


def confine_reader(memory_bytes: int, seconds: int, written_bytes: int, *, children: bool = False) -> None:
    """Limits this process, which reads untrusted files: memory, processor time, output, no children.

    With `children` it may start some, which have the same limits each.

    It gives up the network where the platform lets it; most containers refuse, and have limits of their own.
    """
    for which, most in (
        (resource.RLIMIT_DATA, memory_bytes),
        (resource.RLIMIT_FSIZE, written_bytes),
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_CORE, 0),
    ):
        hard = resource.getrlimit(which)[1]  # who started BT Studio may have set a lower one
        least = most if hard == resource.RLIM_INFINITY else min(most, hard)
        resource.setrlimit(which, (least, least))
    if not children:
        resource.setrlimit(resource.RLIMIT_NPROC, (0, 0))
    ctypes.CDLL(None).unshare(_NEW_USER | _NEW_NET)
