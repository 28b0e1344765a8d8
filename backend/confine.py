"""Makes a server program in a container give up system calls: `python -m backend.confine web PROGRAM…`.

Sessions have a seccomp profile that Docker applies (`backend/sessions/keeper/seccomp.json`). The containers
of the compose file cannot use one: docker-compose 1.29 looks for the file of a profile in the current folder,
Compose v2 beside the compose file. And the default profile of Docker 20.10 admits AF_VSOCK and io_uring. So
these programs give up the calls that they never need; the kernel enforces this for their children too.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import struct
import sys
from typing import Final

PR_SET_NO_NEW_PRIVS: Final = 38
PR_SET_SECCOMP: Final = 22
SECCOMP_MODE_FILTER: Final = 2
# Offsets in `struct seccomp_data` of the call's number, the architecture, and the low half of the first
# argument.
NUMBER_AT: Final = 0
ARCHITECTURE_AT: Final = 4
FIRST_AT: Final = 16
LOAD: Final = 0x20
IS_EQUAL: Final = 0x15
IS_AT_LEAST: Final = 0x35
RETURN: Final = 0x06
ALLOW: Final = 0x7FFF0000
REFUSE: Final = 0x00050000 | errno.EPERM
X32: Final = 0x40000000  # the same calls under other numbers

ARCHITECTURES: Final = {"x86_64": 0xC000003E, "aarch64": 0xC00000B7}
SOCKET: Final = {"x86_64": 41, "aarch64": 198}
# Calls that no program needs: tracing others, mounts, namespaces, keys, the kernel's programs and modules,
# asynchronous I/O in the kernel.
NEVER: Final = {
    "x86_64": (
        *(101, 134, 153, 154, 155, 156, 161, 163, 165, 166, 167, 168, 169, 172, 173, 174, 175, 176),
        *(206, 212, 246, 248, 249, 250, 272, 298, 304, 308, 310, 311, 313, 320, 321, 323),
        *(425, 426, 427, 428, 429, 430, 431, 432, 433, 438, 442),
    ),
    "aarch64": (
        *(0, 39, 40, 41, 51, 89, 97, 104, 105, 106, 117, 142, 217, 218, 219, 224, 225),
        *(241, 265, 268, 270, 271, 273, 280, 282, 294),
        *(425, 426, 427, 428, 429, 430, 431, 432, 433, 438, 442),
    ),
}
# The numbers of fork and vfork, which few programs use, and of execve and execveat.
PROGRAMS: Final = {"x86_64": (57, 58, 59, 322), "aarch64": (221, 281)}
# The numbers of clone, clone3 and connect.
THREADS_AND_CONNECT: Final = {"x86_64": (56, 435, 42), "aarch64": (220, 435, 203)}
UNIX: Final = (1,)
UNIX_IP_NETLINK: Final = (1, 2, 10, 16)


def confine(role: str) -> None:
    """Gives up irrevocably the system calls that a program of this role never needs.

    Args:
        role: `gate` starts no program and opens no connection; `keeper` starts no program and connects only
            to unix sockets; `web` gives up `NEVER`, and the socket families that lead out of its network.

    Raises:
        OSError: the kernel or the machine's architecture does not support the filter.
    """
    machine = platform.machine()
    if machine not in ARCHITECTURES:
        raise OSError(errno.ENOSYS, f"no filter of system calls for {machine}")
    refused = NEVER[machine]
    if role in {"gate", "keeper"}:
        refused += PROGRAMS[machine]
    if role == "gate":
        refused += THREADS_AND_CONNECT[machine]
    _apply(_filter(machine, refused, UNIX_IP_NETLINK if role == "web" else UNIX))


def _filter(machine: str, refused: tuple[int, ...], families: tuple[int, ...]) -> bytes:
    """Returns the kernel's filter program for system calls, as an array of `struct sock_filter`."""
    steps = [(LOAD, 0, 0, ARCHITECTURE_AT), (IS_EQUAL, 1, 0, ARCHITECTURES[machine]), (RETURN, 0, 0, REFUSE)]
    steps += [(LOAD, 0, 0, NUMBER_AT), (IS_AT_LEAST, 0, 1, X32), (RETURN, 0, 0, REFUSE)]
    for number in refused:
        steps += [(IS_EQUAL, 0, 1, number), (RETURN, 0, 0, REFUSE)]
    steps += [(IS_EQUAL, 1, 0, SOCKET[machine]), (RETURN, 0, 0, ALLOW), (LOAD, 0, 0, FIRST_AT)]
    for family in families:
        steps += [(IS_EQUAL, 0, 1, family), (RETURN, 0, 0, ALLOW)]
    steps += [(RETURN, 0, 0, REFUSE)]
    return b"".join(struct.pack("=HBBI", *step) for step in steps)


def _apply(program: bytes) -> None:
    prctl = ctypes.CDLL(None, use_errno=True).prctl
    prctl.argtypes = [ctypes.c_int, *(ctypes.c_ulong,) * 4]
    held = ctypes.create_string_buffer(program, len(program))
    described = ctypes.create_string_buffer(struct.pack("@HP", len(program) // 8, ctypes.addressof(held)))
    for call in (
        (PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0),
        (PR_SET_SECCOMP, SECCOMP_MODE_FILTER, ctypes.addressof(described), 0, 0),
    ):
        if prctl(*call) != 0:
            raise OSError(ctypes.get_errno(), "the kernel takes no filter of system calls")


def main(arguments: list[str]) -> None:
    """Applies the filter and executes the program."""
    role, program, *rest = arguments
    try:
        confine(role)
    except OSError as error:
        sys.stderr.write(f"confine: the program may make all the calls that its container may: {error}\n")
    os.execvp(program, [program, *rest])  # noqa: S606 - the image's own program


if __name__ == "__main__":
    main(sys.argv[1:])
