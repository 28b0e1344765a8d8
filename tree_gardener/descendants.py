"""The end of the processes that users' code starts in a run, also of those that leave their parent."""

import contextlib
import ctypes
import os
import select
import signal
import time
from collections.abc import Callable
from pathlib import Path
from types import FrameType
from typing import Final

__all__ = ["RunChildren", "adopt_orphans", "descendants", "end_with", "guarded"]

BURIAL_S: Final = 0.002
"""Pause between two looks whether processes that were killed are gone."""
_PR_SET_PDEATHSIG: Final = 1
_PR_SET_CHILD_SUBREAPER: Final = 36


def _prctl(option: int, value: int) -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(option, ctypes.c_ulong(value), 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl failed")


def adopt_orphans() -> None:
    """Makes this process the parent of descendants that lose their own parent, so that it can end them."""
    _prctl(_PR_SET_CHILD_SUBREAPER, 1)


def end_with(parent: int) -> None:
    """Makes the kernel kill this process when its parent ends; ends it now if that has ended before.

    Args:
        parent: the process id of the parent, as the parent itself had read it.
    """
    _prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(1)


def descendants(pid: int) -> list[int]:
    """Returns all descendants of a process, parents first."""
    found: list[int] = []
    line = [pid]
    while line:
        for child in _children(line.pop()):
            found.append(child)
            line.append(child)
    return found


def _children(pid: int) -> list[int]:
    found: list[int] = []
    try:
        for task in os.scandir(f"/proc/{pid}/task"):
            found += map(int, Path(task.path, "children").read_bytes().split())
    except OSError:
        pass
    return found


class RunChildren:
    """The processes that users' code starts in this process during a run; they end with the run.

    A process that its own parent leaves becomes one of this process, and ends, too.
    """

    def __init__(self) -> None:
        adopt_orphans()
        self._before = set(descendants(os.getpid()))

    def end(self) -> None:
        """Kills them, until none is left."""
        while left := set(descendants(os.getpid())) - self._before:
            for pid in left:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            # Not one after the other: the first process of a namespace ends when all others are buried.
            for pid in left:
                with contextlib.suppress(ChildProcessError):  # one of another process comes to this one
                    os.waitpid(pid, os.WNOHANG)
            time.sleep(BURIAL_S)


class _EndedError(BaseException):
    """This process was asked to end."""


def guarded(main: Callable[[], int], parent: int) -> int:
    """Runs a program in a fork, and returns its exit status when all that it has started has ended.

    SIGTERM, or the end of this process's parent, ends the program. To be called before this process has
    threads; without Linux nothing is forked.

    Args:
        main: the program; it returns its exit status.
        parent: the process id of this process's parent, as that had read it: it may have ended before this
            process could ask.
    """
    if not hasattr(os, "pidfd_open"):
        return main()
    children = RunChildren()
    before = signal.signal(signal.SIGTERM, _ask_to_end)
    program, status = -1, 128 + signal.SIGTERM
    own = os.getpid()
    with contextlib.suppress(_EndedError, ProcessLookupError):
        watched = os.pidfd_open(parent)
        if os.getppid() != parent:
            raise _EndedError
        program = os.fork()
        if program != 0:
            ends = {watched, its := os.pidfd_open(program)}
            if its in select.select(ends, [], [])[0]:
                status = os.waitstatus_to_exitcode(os.waitpid(program, 0)[1])
    if program == 0:
        signal.signal(signal.SIGTERM, before)
        os.close(watched)
        os.setpgid(0, 0)  # a signal to its group does not reach the process that ends it
        end_with(own)
        return main()
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    children.end()
    return status


def _ask_to_end(_number: int, _frame: FrameType | None) -> None:
    raise _EndedError
