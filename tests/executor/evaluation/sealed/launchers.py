"""`python -m …sealed.launchers LAUNCHER PROGRAM…`: a program as a launcher of sessions starts it.

`root` and `user` are processes of this machine. `docker` and `kubernetes` are what a session's container is
to a process, as the keeper's plan and the pod's manifest say: a uid without capabilities that may not become
more, a filter of system calls that admits no namespaces, a read-only root, memory at `/tmp` and `/dev/shm`,
and one network and IPC namespace for all runs. `tests/docker/test_sealed.py` uses a real engine.
"""

from __future__ import annotations

import ctypes
import fcntl
import os
import socket
import struct
import sys
from pathlib import Path

from executor.evaluation.sealed.confine import readable_folders
from executor.evaluation.sealed.namespaces import open_ways
from tests.backend.sessions.keeper.confined import ALLOW, EPERM, ERRNO, confine

ROOT = Path(__file__).parents[4]
WITHOUT_MOUNTS = "user without mounts"
"""An ordinary user of a system that gives namespaces without the right to mount in them."""
UID = 10001
SHOWN = "BT_STUDIO_TEST_SHOWN"
TO_SHOW = Path("/tmp/shown")  # noqa: S108 - in the sandbox's own memory
"""Where a launcher other than `root` has the folder that this variable names."""
LAUNCHERS = ("root", "user", "docker", "kubernetes") if os.getuid() == 0 else ("user",)
STARTED = (*LAUNCHERS, WITHOUT_MOUNTS)
NEW_NS, NEW_IPC, NEW_NET = 0x20000, 0x08000000, 0x40000000
PRIVATE = 1 << 18 | 1 << 14
BIND = 1 << 12


def start_as(launcher: str) -> None:
    """Makes this process what the launcher gives."""
    if os.getuid() == 0 and launcher != "root":
        _leave_root(in_container=launcher in {"docker", "kubernetes"})
    if launcher in {"docker", "kubernetes"}:
        confine()
    if launcher == WITHOUT_MOUNTS:
        _refuse_mounts()


def _leave_root(*, in_container: bool) -> None:
    libc = ctypes.CDLL(None, use_errno=True)
    assert libc.unshare(NEW_NS | (NEW_IPC | NEW_NET if in_container else 0)) == 0
    assert libc.mount(None, b"/", None, PRIVATE, None) == 0
    shown = os.open(os.environ.get(SHOWN, "/"), os.O_PATH)
    if in_container:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_:
            fcntl.ioctl(any_, 0x8914, struct.pack("16sH14x", b"lo", 0x41))  # the loopback is up
        read_only = struct.pack("QQQQ", 1, 0, 0, 0)
        assert libc.syscall(442, -100, b"/", 0x8000, read_only, ctypes.c_size_t(32)) == 0
    for folder in (b"/tmp", b"/dev/shm")[: 2 if in_container else 1]:
        assert libc.mount(b"tmpfs", folder, b"tmpfs", 6, b"mode=1777,size=268435456") == 0
    TO_SHOW.mkdir()
    assert libc.mount(f"/proc/self/fd/{shown}".encode(), bytes(TO_SHOW), None, BIND, None) == 0
    os.close(shown)
    # Python may be in root's own folder.
    open_ways([*readable_folders(), ROOT / "tests", ROOT / "backend"])
    os.setgroups([])
    os.setresgid(UID, UID, UID)
    os.setresuid(UID, UID, UID)
    os.environ["HOME"] = os.environ["TMPDIR"] = "/tmp"  # noqa: S108 - as in the container


def _refuse_mounts() -> None:
    lib = ctypes.CDLL("libseccomp.so.2")
    lib.seccomp_init.restype = ctypes.c_void_p
    context = ctypes.c_void_p(lib.seccomp_init(ALLOW))
    number = lib.seccomp_syscall_resolve_name(b"mount")
    assert lib.seccomp_rule_add(context, ERRNO | EPERM, number, 0) == 0
    assert lib.seccomp_load(context) == 0


if __name__ == "__main__":
    start_as(sys.argv[1])
    os.execv(sys.argv[2], sys.argv[2:])  # noqa: S606 - a program of the tests
