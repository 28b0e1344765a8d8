"""Seals this process: it reads Python, its libraries and its own folder, and touches no other process.

Three layers, the first of which must hold:

1. Landlock (Linux 5.13): files outside the list cannot be opened, `/proc` among them; no process outside can
   be traced; newer kernels also refuse TCP and signals to processes outside.
2. Namespaces of its own for mounts, network and IPC, where the platform lets it: an empty `/dev/shm`, and a
   loopback that nobody else hears.
3. A uid of its own, where it may change it; else it gives up its capabilities.

It has to be called while the process has one thread, since Landlock holds for a thread and what it starts.
"""

from __future__ import annotations

import ctypes
import fcntl
import os
import resource
import signal
import socket
import struct
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

FIRST_UID: Final = 61184
LAST_UID: Final = 65519
"""The range from which systemd, too, gives uids to services that have none of their own."""
MOST_PROCESSES: Final = 256
SYSTEM: Final = ("/bin", "/etc", "/lib", "/lib64", "/sbin", "/usr", "/sys/devices/system/cpu")
DEVICES: Final = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")
SHARED: Final = "/dev/shm"  # noqa: S108 - the shared memory of the middleware

_PR_SET_PDEATHSIG, _PR_SET_NO_NEW_PRIVS, _PR_CAPBSET_DROP = 1, 38, 24
_NEW_NS, _NEW_IPC, _NEW_USER, _NEW_NET = 0x20000, 0x08000000, 0x10000000, 0x40000000
_MS_PRIVATE, _MS_REC, _MS_BIND, _MS_NOSUID, _MS_NODEV = 1 << 18, 1 << 14, 1 << 12, 2, 4
_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_CAPSETS: Final = {"x86_64": 126, "aarch64": 91}
_UNDER_PATH: Final = 1
_EXECUTE, _WRITE, _READ, _LIST, _TRUNCATE, _IOCTL = 1, 2, 4, 8, 1 << 14, 1 << 15
_FS_BITS: Final = {1: 13, 2: 14, 3: 15, 4: 15}
"""The number of rights of files by the version of Landlock; 16 from version 5 on."""
_NET: Final = 3
_SCOPES: Final = 3


class SealError(RuntimeError):
    """This platform cannot seal a process; the text says why."""


def landlock_version() -> int:
    """Returns the version of the kernel's Landlock; 0 if it has none."""
    return max(0, int(_libc().syscall(_CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(1))))


def require_seal() -> None:
    """Raises SealError if runs cannot be sealed here."""
    if landlock_version() < 1:
        raise SealError(
            "this machine cannot seal runs: its kernel has no Landlock (Linux 5.13 or later, with `landlock` "
            "in /sys/kernel/security/lsm)"
        )


def seal(scratch: Path, *, uid: int | None = None) -> None:
    """Seals this process, which has one thread, and all that it starts.

    Args:
        scratch: the folder that it may write.
        uid: the uid that it gets, if it is root's.

    Raises:
        SealError: Landlock refuses.
    """
    require_seal()
    readable = readable_folders()
    own = _separate(readable, uid)
    _leave_rights(uid if own else None)
    libc = _libc()
    libc.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)  # a change of the uid has cleared it
    libc.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if own:
        resource.setrlimit(resource.RLIMIT_NPROC, (MOST_PROCESSES, MOST_PROCESSES))
    _restrict(readable, scratch)


def free_uid() -> int | None:
    """Returns a uid for a sealed process, or None if this process may not change its uid."""
    return FIRST_UID + os.getpid() % (LAST_UID - FIRST_UID) if os.getuid() == 0 else None


def readable_folders() -> list[Path]:
    """Returns the folders that hold Python, the libraries and BT Studio's own code."""
    code = Path(__file__).parents[3]
    found = [Path(sys.prefix), Path(sys.base_prefix), *map(Path, sys.path)]
    own = [code / name for name in ("executor", "translator", "tree_gardener")]
    kept = [
        path.resolve() for path in found if path.is_absolute() and path.exists() and path.resolve() != code
    ]
    return list(dict.fromkeys([*kept, *own, *(Path(name) for name in SYSTEM if Path(name).exists())]))


# --- namespaces and rights ---


def _separate(readable: Sequence[Path], uid: int | None) -> bool:
    """Enters namespaces of its own; returns whether another uid can read what it needs."""
    libc = _libc()
    before = os.getuid(), os.getgid()
    is_root = uid is not None
    # Without rights on the machine, a namespace of users gives them on the other ones.
    flags = _NEW_NS | _NEW_IPC | _NEW_NET | (0 if is_root else _NEW_USER)
    if libc.unshare(flags) != 0:
        return is_root and all(map(_is_open_to_all, readable))
    if not is_root:
        _map_ids(*before)
    libc.mount(None, b"/", None, _MS_REC | _MS_PRIVATE, None)
    libc.mount(b"tmpfs", SHARED.encode(), b"tmpfs", _MS_NOSUID | _MS_NODEV, b"mode=1777")
    _raise_loopback()
    return is_root and _open_ways(readable)


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


def _open_ways(readable: Sequence[Path]) -> bool:
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


def _leave_rights(uid: int | None) -> None:
    if uid is not None:
        os.setgroups([])
        os.setresgid(uid, uid, uid)
        os.setresuid(uid, uid, uid)
        return
    libc = _libc()
    for capability in range(64):
        libc.prctl(_PR_CAPBSET_DROP, capability, 0, 0, 0)
    header, none = struct.pack("Ii", 0x20080522, 0), bytes(24)
    libc.syscall(_CAPSETS[os.uname().machine], header, none)


# --- Landlock ---


def _restrict(readable: Iterable[Path], scratch: Path) -> None:
    version = landlock_version()
    every = (1 << _FS_BITS.get(version, 16)) - 1
    parts = [every, _NET if version >= 4 else 0, _SCOPES if version >= 6 else 0]
    attributes = struct.pack("QQQ", *parts)[: 8 if version < 4 else 16 if version < 6 else 24]
    rules = int(_libc().syscall(_CREATE_RULESET, attributes, ctypes.c_size_t(len(attributes)), 0))
    if rules < 0:
        raise SealError("Landlock refuses")
    try:
        for path in readable:
            _allow(rules, path, _EXECUTE | _READ | _LIST)
        for path in (scratch, Path(SHARED)):
            _allow(rules, path, every & ~_IOCTL)
        for name in DEVICES:
            _allow(rules, Path(name), (_READ | _WRITE | _TRUNCATE) & every)
        if _libc().syscall(_RESTRICT_SELF, rules, 0) != 0:
            raise SealError("Landlock refuses")
    finally:
        os.close(rules)


def _allow(rules: int, path: Path, rights: int) -> None:
    try:
        handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except FileNotFoundError:
        return
    try:
        if not path.is_dir():
            rights &= _EXECUTE | _READ | _WRITE | _TRUNCATE
        rule = struct.pack("=Qi", rights, handle)
        if _libc().syscall(_ADD_RULE, rules, _UNDER_PATH, rule, 0) != 0:
            raise SealError(f"Landlock refuses a rule for {path}")
    finally:
        os.close(handle)


def _libc() -> Any:
    return ctypes.CDLL(None, use_errno=True)
