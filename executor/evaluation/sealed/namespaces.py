"""Namespaces for a sealed process alone, where the platform lets it: mounts, network, IPC, processes."""

from __future__ import annotations

import ctypes
import fcntl
import os
import signal
import socket
import struct
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

SHARED: Final = "/dev/shm"  # noqa: S108 - shared memory
MOST_BYTES: Final = 128 << 20
"""Of the shared memory, and of one file."""
FOLDER_BYTES: Final = 384 << 20
"""Of the folder: a project of the largest size, and as much as a file."""
MOST_FILES: Final = 20_000

_PR_SET_PDEATHSIG: Final = 1
_NEW_NS, _NEW_IPC, _NEW_USER, _NEW_PID, _NEW_NET = 0x20000, 0x08000000, 0x10000000, 0x20000000, 0x40000000
_MS_PRIVATE, _MS_REC, _MS_BIND, _MS_NOSUID, _MS_NODEV = 1 << 18, 1 << 14, 1 << 12, 2, 4
_MOUNT_SETATTR, _AT_FDCWD, _AT_RECURSIVE, _RDONLY = 442, -100, 0x8000, 1


class Apart(NamedTuple):
    """The parts of the system that a process shares with nobody.

    Attributes:
        spaces: mounts, network and IPC.
        pids: processes.
        users: the count of its user's processes, so that a limit of them is its own.
        reach: whether another uid reaches the folders that it needs.
    """

    spaces: bool
    pids: bool
    users: bool
    reach: bool


def separate(readable: Sequence[Path], scratch: Path, uid: int | None) -> Apart:
    """Enters its own namespaces, as many as the platform gives.

    In them everything is read-only but the scratch folder and the shared memory, which are empty and bounded.

    Args:
        readable: the folders that the process reads.
        scratch: the folder that it may write.
        uid: the uid that it will get, if it is root's.
    """
    # Without rights on the machine, a namespace of users gives them on the other ones.
    flags = _NEW_NS | _NEW_IPC | _NEW_NET | (_NEW_USER if uid is None else 0)
    before = os.getuid(), os.getgid()
    for pids in (True, False):
        if _libc().unshare(flags | (_NEW_PID if pids else 0)) == 0:
            break
    else:
        reach = uid is not None and all(map(_is_open_to_all, readable))
        return Apart(spaces=False, pids=False, users=reach, reach=reach)
    try:
        if uid is None:
            _map_ids(*before)
        reach = _furnish(readable, scratch, uid)
    except OSError:  # some systems give namespaces without the rights in them
        reach = uid is not None and all(map(_is_open_to_all, readable))
        return Apart(spaces=False, pids=pids, users=reach or uid is None, reach=reach)
    return Apart(spaces=True, pids=pids, users=reach or uid is None, reach=reach)


def _furnish(readable: Sequence[Path], scratch: Path, uid: int | None) -> bool:
    """Mounts what is its own; returns whether another uid reaches what it needs.

    Raises:
        OSError: a mount is refused.
    """
    _check(_libc().mount(None, b"/", None, _MS_REC | _MS_PRIVATE, None))
    attributes = struct.pack("QQQQ", _RDONLY, 0, 0, 0)
    size = ctypes.c_size_t(len(attributes))
    _check(_libc().syscall(_MOUNT_SETATTR, _AT_FDCWD, b"/", _AT_RECURSIVE, attributes, size))
    bounds = f"size={FOLDER_BYTES},nr_inodes={MOST_FILES}"
    _mount_memory(Path(SHARED), f"mode=1777,size={MOST_BYTES}")
    owner = os.getuid() if uid is None else uid
    _mount_memory(scratch, f"mode=700,uid={owner},gid={os.getgid() if uid is None else uid},{bounds}")
    _raise_loopback()
    return uid is not None and open_ways(readable)


def _mount_memory(path: Path, options: str) -> None:
    flags = _MS_NOSUID | _MS_NODEV
    _check(_libc().mount(b"tmpfs", os.fsencode(path), b"tmpfs", flags, options.encode()))


def _check(result: int) -> None:
    if result != 0:
        raise OSError(ctypes.get_errno(), "the mounts of a sealed process are refused")


def _map_ids(uid: int, gid: int) -> None:
    for name, text in (("setgroups", "deny"), ("uid_map", f"{uid} {uid} 1"), ("gid_map", f"{gid} {gid} 1")):
        Path("/proc/self", name).write_text(text, encoding="ascii")


def _raise_loopback() -> None:
    """Makes 127.0.0.1 of the new namespace work."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_:
        up_and_running = 0x41
        fcntl.ioctl(any_, 0x8914, struct.pack("16sH14x", b"lo", up_and_running))  # SIOCSIFFLAGS


def _is_open_to_all(path: Path) -> bool:
    return all(each.stat().st_mode & 1 for each in (path, *path.parents) if each.is_dir())


def open_ways(readable: Sequence[Path]) -> bool:
    """Makes folders that lie in a closed one (such as a Python in `/root`) reachable by another uid.

    The closed folder is covered by an empty one, in which only these folders are bound.
    """
    libc = _libc()
    closed: dict[Path, list[tuple[Path, int]]] = {}
    for path in readable:
        cover = next((each for each in reversed((path, *path.parents)) if not each.stat().st_mode & 1), None)
        if cover == path:
            return False
        if cover is not None:
            closed.setdefault(cover, []).append((path, os.open(path, os.O_PATH)))
    for cover, ways in closed.items():
        if libc.mount(b"tmpfs", os.fsencode(cover), b"tmpfs", _MS_NOSUID | _MS_NODEV, b"mode=755") != 0:
            return False
        for path, handle in sorted(ways):
            if not path.exists():
                path.mkdir(parents=True)
                source = f"/proc/self/fd/{handle}".encode()
                libc.mount(source, os.fsencode(path), None, _MS_BIND | _MS_REC, None)
            os.close(handle)
    return True


def continue_inside() -> None:
    """Returns in a child that is in the new namespace of processes; this process ends as that child does.

    A process that has left its namespace of processes can start no thread. The first process of the new one
    takes in orphans; all others end with it.
    """
    first = os.fork()
    if first == 0:
        _leave_descriptors()
        die_with_parent()
        _take_in_orphans()
    inside = os.fork()
    if inside == 0:
        die_with_parent()
        return
    _leave_descriptors()
    _, status = os.waitpid(inside, 0)
    os.kill(first, signal.SIGKILL)
    os.waitpid(first, 0)
    _end_as(status)


def die_with_parent() -> None:
    """Ends this process when its parent ends. A change of the uid and a fork clear this."""
    _libc().prctl(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)


def _take_in_orphans() -> None:
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGCHLD})
    while True:
        try:
            os.wait()
        except ChildProcessError:
            signal.sigwait({signal.SIGCHLD})


def _leave_descriptors() -> None:
    """Closes the link among others: its end must be heard when the process inside closes it."""
    os.closerange(3, os.sysconf("SC_OPEN_MAX"))


def _end_as(status: int) -> None:
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        with suppress(OSError):  # SIGKILL has no other effect
            signal.signal(number, signal.SIG_DFL)
        os.kill(os.getpid(), number)
    os._exit(os.WEXITSTATUS(status))


def _libc() -> Any:
    return ctypes.CDLL(None, use_errno=True)
