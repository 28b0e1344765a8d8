"""The filter of system calls of a sealed process: what Landlock and namespaces leave open is refused.

The kernel asks the filter at each call of this process and of all that it starts; nobody can take it off. It
refuses with EPERM, so that a library that can do without a call continues.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import struct
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    Step = tuple[int, int, int, int]

ARCHITECTURES: Final = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
NUMBERS: Final = {
    # name: x86_64, aarch64; -1 where the architecture does not have it
    "add_key": (248, 217),
    "bind": (49, 200),
    "bpf": (321, 280),
    "chmod": (90, -1),
    "chown": (92, -1),
    "chroot": (161, 51),
    "clone": (56, 220),
    "clone3": (435, 435),
    "connect": (42, 203),
    "fchmod": (91, 52),
    "fchmodat": (268, 53),
    "fchmodat2": (452, 452),
    "fchown": (93, 55),
    "fchownat": (260, 54),
    "file_setattr": (469, 469),
    "fremovexattr": (199, 16),
    "fsconfig": (431, 431),
    "fsetxattr": (190, 7),
    "fsmount": (432, 432),
    "fsopen": (430, 430),
    "fspick": (433, 433),
    "futimesat": (261, -1),
    "io_uring_enter": (426, 426),
    "io_uring_register": (427, 427),
    "io_uring_setup": (425, 425),
    "ioctl": (16, 29),
    "ioprio_set": (251, 30),
    "kcmp": (312, 272),
    "keyctl": (250, 219),
    "kill": (62, 129),
    "lchown": (94, -1),
    "listen": (50, 201),
    "lremovexattr": (198, 15),
    "lsetxattr": (189, 6),
    "mount": (165, 40),
    "mount_setattr": (442, 442),
    "move_mount": (429, 429),
    "mq_open": (240, 180),
    "mq_unlink": (241, 181),
    "msgctl": (71, 187),
    "msgget": (68, 186),
    "msgrcv": (70, 188),
    "msgsnd": (69, 189),
    "open_by_handle_at": (304, 265),
    "open_tree": (428, 428),
    "perf_event_open": (298, 241),
    "pidfd_getfd": (438, 438),
    "pidfd_send_signal": (424, 424),
    "pivot_root": (155, 41),
    "prlimit64": (302, 261),
    "process_madvise": (440, 440),
    "process_mrelease": (448, 448),
    "process_vm_readv": (310, 270),
    "process_vm_writev": (311, 271),
    "ptrace": (101, 117),
    "removexattr": (197, 14),
    "removexattrat": (466, 466),
    "request_key": (249, 218),
    "rt_sigqueueinfo": (129, 138),
    "rt_tgsigqueueinfo": (297, 240),
    "sched_setaffinity": (203, 122),
    "sched_setattr": (314, 274),
    "sched_setparam": (142, 118),
    "sched_setscheduler": (144, 119),
    "semctl": (66, 191),
    "semget": (64, 190),
    "semop": (65, 193),
    "semtimedop": (220, 192),
    "sendmmsg": (307, 269),
    "sendmsg": (46, 211),
    "sendto": (44, 206),
    "setns": (308, 268),
    "setpriority": (141, 140),
    "setxattr": (188, 5),
    "setxattrat": (463, 463),
    "shmat": (30, 196),
    "shmctl": (31, 195),
    "shmget": (29, 194),
    "socket": (41, 198),
    "socketpair": (53, 199),
    "tgkill": (234, 131),
    "tkill": (200, 130),
    "truncate": (76, 45),
    "umount2": (166, 39),
    "unshare": (272, 97),
    "userfaultfd": (323, 282),
    "utime": (132, -1),
    "utimensat": (280, 88),
    "utimes": (235, -1),
}
NEVER: Final = (
    # io_uring makes sockets by itself
    *("io_uring_setup", "io_uring_enter", "io_uring_register"),
    *("unshare", "setns", "mount", "umount2", "pivot_root", "chroot", "open_tree", "move_mount"),
    *("fsopen", "fsconfig", "fsmount", "fspick", "mount_setattr", "open_by_handle_at"),
    *("ptrace", "process_vm_readv", "process_vm_writev", "process_madvise", "process_mrelease"),
    *("pidfd_getfd", "kcmp", "bpf", "perf_event_open", "userfaultfd"),
    # keys are kept for a user, beyond the process
    *("add_key", "request_key", "keyctl"),
)
IPC: Final = (
    *("shmget", "shmat", "shmctl", "semget", "semop", "semtimedop", "semctl"),
    *("msgget", "msgsnd", "msgrcv", "msgctl", "mq_open", "mq_unlink"),
)
ADDRESSES: Final = ("bind", "connect", "listen", "sendmsg", "sendmmsg")
METADATA: Final = (
    *("chmod", "fchmod", "fchmodat", "fchmodat2", "chown", "lchown", "fchown", "fchownat"),
    *("utime", "utimes", "futimesat", "utimensat", "file_setattr"),
    *("setxattr", "lsetxattr", "fsetxattr", "setxattrat"),
    *("removexattr", "lremovexattr", "fremovexattr", "removexattrat", "truncate"),
)
"""What changes a file without opening it for writing, of which Landlock knows nothing (before version 3)."""
OWN_ONLY: Final = {
    # name: the argument that is an id of a process or thread
    "prlimit64": 0,
    "sched_setaffinity": 0,
    "sched_setattr": 0,
    "sched_setparam": 0,
    "sched_setscheduler": 0,
}
OF_PROCESS: Final = {"setpriority": 0, "ioprio_set": 1}
"""Calls for a process (the value of the first argument), a group or a user; the second is the id."""
SIGNALS: Final = {"kill": 0, "tgkill": 0, "rt_sigqueueinfo": 0, "rt_tgsigqueueinfo": 0}
LOOSE_SIGNALS: Final = ("tkill", "pidfd_send_signal")
SET_FLAGS: Final = (0x40086602, 0x401C5820)
"""The requests of ioctl that change a file's flags."""
NEW_NAMESPACES: Final = 0x7E020000
STREAM, SEQUENCED = 1, 5
"""The types of socket pairs whose ends cannot be connected to anything else."""
KIND_OF_SOCKET: Final = 0xF
INET, INET6, NETLINK = 2, 10, 16

_SET_NO_NEW_PRIVS, _SET_SECCOMP, _MODE_FILTER = 38, 22, 2
_LOAD, _AND, _EQUAL, _AT_LEAST, _ANY_BIT, _RETURN = 0x20, 0x54, 0x15, 0x35, 0x45, 0x06
_NUMBER_AT, _ARCHITECTURE_AT, _ARGUMENTS_AT = 0, 4, 16
_X32: Final = 0x40000000
_ALLOW: Final[Step] = (_RETURN, 0, 0, 0x7FFF0000)
_REFUSE: Final[Step] = (_RETURN, 0, 0, 0x00050000 | errno.EPERM)
_UNKNOWN: Final[Step] = (_RETURN, 0, 0, 0x00050000 | errno.ENOSYS)


def restrict_calls(*, network: bool, ipc: bool, files: bool, signals: bool) -> None:
    """Gives up irrevocably the calls that lead out of this process, which has one thread.

    Args:
        network: its network is its own; otherwise its sockets have no address, and reach nobody. (The
            middleware wants to make some, and delivers within the process without them.)
        ipc: its System V objects and message queues are its own.
        files: nothing is mounted writable but its own folders.
        signals: the kernel refuses its signals to processes outside.

    Raises:
        OSError: the kernel or the machine's architecture does not support the filter.
    """
    machine = platform.machine()
    if machine not in ARCHITECTURES:
        raise OSError(errno.ENOSYS, f"no filter of system calls for {machine}")
    pid = None if signals else os.getpid()
    _apply(filter_of(machine, network=network, ipc=ipc, files=files, pid=pid))


def filter_of(machine: str, *, network: bool, ipc: bool, files: bool, pid: int | None) -> bytes:
    """Returns the kernel's program, as an array of `struct sock_filter`.

    Args:
        machine: the architecture.
        network: as of `restrict_calls`.
        ipc: as above.
        files: as above.
        pid: the one process that gets signals; None leaves them to the kernel.
    """
    place = list(ARCHITECTURES).index(machine)
    steps: list[Step] = [(_LOAD, 0, 0, _ARCHITECTURE_AT), (_EQUAL, 1, 0, ARCHITECTURES[machine]), _REFUSE]
    steps += [(_LOAD, 0, 0, _NUMBER_AT), (_AT_LEAST, 0, 1, _X32), _REFUSE]

    def add(name: str, rule: Sequence[Step]) -> None:
        number = NUMBERS[name][place]
        if number >= 0:
            steps.extend([(_EQUAL, 0, len(rule), number), *rule])

    refused = [*NEVER, *(() if ipc else IPC), *(() if files else METADATA)]
    refused += () if network else ADDRESSES
    refused += LOOSE_SIGNALS if pid is not None else ()
    for name in refused:
        add(name, [_REFUSE])
    add("clone3", [_UNKNOWN])  # its flags cannot be read, and every library falls back on clone
    add("clone", [_argument(0), (_ANY_BIT, 0, 1, NEW_NAMESPACES), _REFUSE, _ALLOW])
    add("socket", _one_of(0, (INET, INET6, NETLINK) if network else (INET, INET6)))
    if not network:  # a socket of a pair has no need of an address
        add("sendto", [_argument(4), (_EQUAL, 0, 3, 0), _high(4), (_EQUAL, 0, 1, 0), _ALLOW, _REFUSE])
    add("socketpair", [_argument(1), (_AND, 0, 0, KIND_OF_SOCKET), *_among((STREAM, SEQUENCED))])
    for name, argument in OWN_ONLY.items():
        add(name, _one_of(argument, (0,)))
    for name, process in OF_PROCESS.items():
        add(name, [_argument(0), (_EQUAL, 1, 0, process), _REFUSE, *_one_of(1, (0,))])
    if not files:
        add("ioctl", [_argument(1), *(s for f in SET_FLAGS for s in ((_EQUAL, 0, 1, f), _REFUSE)), _ALLOW])
    if pid is not None:
        for name, argument in SIGNALS.items():
            add(name, _one_of(argument, (0, pid) if name == "kill" else (pid,)))
    return b"".join(struct.pack("=HBBI", *step) for step in [*steps, _ALLOW])


def _argument(index: int) -> Step:
    """Loads the low half of an argument; the kernel reads no more of ids, families and types."""
    return (_LOAD, 0, 0, _ARGUMENTS_AT + 8 * index)


def _high(index: int) -> Step:
    return (_LOAD, 0, 0, _ARGUMENTS_AT + 8 * index + 4)


def _one_of(argument: int, values: Iterable[int]) -> list[Step]:
    return [_argument(argument), *_among(values)]


def _among(values: Iterable[int]) -> list[Step]:
    return [*(step for value in values for step in ((_EQUAL, 0, 1, value), _ALLOW)), _REFUSE]


def _apply(program: bytes) -> None:
    prctl = ctypes.CDLL(None, use_errno=True).prctl
    prctl.argtypes = [ctypes.c_int, *(ctypes.c_ulong,) * 4]
    held = ctypes.create_string_buffer(program, len(program))
    described = ctypes.create_string_buffer(struct.pack("@HP", len(program) // 8, ctypes.addressof(held)))
    for call in (
        (_SET_NO_NEW_PRIVS, 1, 0, 0, 0),
        (_SET_SECCOMP, _MODE_FILTER, ctypes.addressof(described), 0, 0),
    ):
        if prctl(*call) != 0:
            raise OSError(ctypes.get_errno(), "the kernel takes no filter of system calls")
