"""Makes a copy of a process a process of its own, in the manager's eyes and in the kernel's.

A copy shares all open files, its session and its mark with the process from which it was forked; here it gets
its own.
"""

from __future__ import annotations

import contextlib
import ctypes
import fcntl
import os
import socket
import stat
import time
from pathlib import Path
from typing import Final

from executor.supervision.confine import forks_survive
from tree_gardener.descendants import end_with

__all__ = ["SNAPSHOT_NAME", "fork_away", "forked_copy", "name_process", "renew_files", "stand_alone"]

MARK: Final = "BT_STUDIO_CHILD"
ADOPTED_S: Final = 5.0
SNAPSHOT_NAME: Final = "bt-snapshot"
"""The name of the process of a snapshot."""
_KEPT_FLAGS: Final = os.O_ACCMODE | os.O_APPEND | os.O_NONBLOCK


def fork_away() -> int | None:
    """Forks a process that is nobody's child here: the manager, as the reaper of its descendants, adopts it.

    Returns the id of a process that ends immediately, for `os.waitpid`; in the copy, None.

    Raises:
        OSError: no process can be forked now.
    """
    with forks_survive():
        between = os.fork()
        if between:
            return between
        try:
            if os.fork():
                os._exit(0)
        except OSError:
            os._exit(1)
        return None


def stand_alone() -> str:
    """Makes this copy survive the process from which it was forked; returns its mark."""
    os.setsid()
    mark = os.urandom(8).hex()
    _mark(mark)
    return mark


def name_process(name: str) -> None:
    """Sets the name under which the kernel lists this process."""
    with contextlib.suppress(OSError):
        Path("/proc/self/comm").write_text(name)


def forked_copy(parent_pid: int) -> None:
    """Binds the life of this copy to that of the manager, once that has adopted it."""
    until_s = time.monotonic() + ADOPTED_S
    while os.getppid() != parent_pid:
        if time.monotonic() > until_s:
            os._exit(1)  # the manager is gone
        time.sleep(0.001)
    end_with(parent_pid)


def renew_files() -> None:
    """Opens regular files and datagram sockets again, which the copy would share with the first process.

    A file that cannot be opened again stays shared. Standard streams lead nowhere until `os.dup2` sets them.
    """
    nowhere = os.open(os.devnull, os.O_RDWR)
    for fd in (1, 2):
        os.dup2(nowhere, fd)
    os.close(nowhere)
    for fd in [int(path.name) for path in Path("/proc/self/fd").iterdir()]:
        with contextlib.suppress(OSError):
            kind = os.fstat(fd).st_mode
            if stat.S_ISREG(kind):
                _reopen(fd)
            elif stat.S_ISSOCK(kind):
                _renew_socket(fd)


def _reopen(fd: int) -> None:
    if not os.fstat(fd).st_nlink:
        return  # a file in memory, or one that was removed
    flags = fcntl.fcntl(fd, fcntl.F_GETFL) & _KEPT_FLAGS
    at = os.lseek(fd, 0, os.SEEK_CUR)
    again = os.open(f"/proc/self/fd/{fd}", flags | os.O_CLOEXEC)
    os.lseek(again, at, os.SEEK_SET)
    os.dup2(again, fd, inheritable=os.get_inheritable(fd))
    os.close(again)


def _renew_socket(fd: int) -> None:
    """Replaces a datagram socket of the Internet by one that nobody else reads."""
    with socket.socket(fileno=os.dup(fd)) as old:
        family, kind = old.family, old.type
    if family not in (socket.AF_INET, socket.AF_INET6) or kind != socket.SOCK_DGRAM:
        return
    is_blocking = os.get_blocking(fd)
    with socket.socket(family, kind) as new:
        new.setblocking(is_blocking)
        os.dup2(new.fileno(), fd, inheritable=os.get_inheritable(fd))


def _mark(mark: str) -> None:
    """Replaces the mark in the environment with which this process was started, as `/proc` shows it.

    The manager takes processes with the same mark for descendants of the first process.
    """
    os.environ[MARK] = mark
    fields = Path("/proc/self/stat").read_text().rpartition(")")[2].split()
    begin, end = int(fields[47]), int(fields[48])
    there = Path("/proc/self/environ").read_bytes()
    key = f"{MARK}=".encode()
    at = 0 if there.startswith(key) else there.find(b"\0" + key) + 1
    if there[at : at + len(key)] != key or not begin or end - begin < len(there):
        return
    value = there[at + len(key) :].partition(b"\0")[0]
    if len(value) == len(mark):
        ctypes.memmove(begin + at + len(key), mark.encode(), len(mark))
