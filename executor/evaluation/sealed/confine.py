"""Seals this process: it reads Python, its libraries and its own folder, and touches no other process.

Four layers, of which the first two must hold:

1. Landlock (Linux 5.13): files outside the list cannot be opened, `/proc` among them; no process outside can
   be traced; newer kernels also refuse TCP and signals to processes outside (`landlock`).
2. A filter of system calls, for what Landlock leaves open; it refuses the more, the less of the third layer
   there is (`system_calls`).
3. Its own namespaces for mounts, network, IPC and processes, where the platform lets it (`namespaces`).
4. Its own uid, where it may change it; else it gives up its capabilities.

It has to be called while the process has one thread, since Landlock holds for a thread and what it starts.
"""

from __future__ import annotations

import ctypes
import os
import platform
import resource
import struct
import sys
from pathlib import Path
from typing import Any, Final

from executor.evaluation.sealed.landlock import SIGNALS_SINCE, SealError, landlock_version, restrict_files
from executor.evaluation.sealed.namespaces import (
    MOST_BYTES,
    SHARED,
    continue_inside,
    die_with_parent,
    separate,
)
from executor.evaluation.sealed.system_calls import ARCHITECTURES, restrict_calls

__all__ = ["SealError", "free_uid", "readable_folders", "require_seal", "seal"]

FIRST_UID: Final = 61184
LAST_UID: Final = 65519
"""The range from which systemd, too, gives uids to services that have none of their own."""
MOST_PROCESSES: Final = 256
SYSTEM: Final = ("/bin", "/etc", "/lib", "/lib64", "/sbin", "/usr", "/sys/devices/system/cpu")

_PR_GET_SECCOMP, _PR_SET_NO_NEW_PRIVS, _PR_CAPBSET_DROP = 21, 38, 24
_CAPSETS: Final = {"x86_64": 126, "aarch64": 91}


def require_seal() -> None:
    """Raises SealError if runs cannot be sealed here."""
    if landlock_version() < 1:
        raise SealError(
            "this machine cannot seal runs: its kernel has no Landlock (Linux 5.13 or later, with `landlock` "
            "in /sys/kernel/security/lsm)"
        )
    if platform.machine() not in ARCHITECTURES or _libc().prctl(_PR_GET_SECCOMP, 0, 0, 0, 0) < 0:
        raise SealError(
            "this machine cannot seal runs: it needs filters of system calls (a kernel with "
            f"CONFIG_SECCOMP_FILTER) on {' or '.join(ARCHITECTURES)}"
        )


def seal(scratch: Path, *, uid: int | None = None) -> None:
    """Seals this process, which has one thread, and all that it starts.

    Where there is a namespace of processes, it returns in a child, and this process ends as that child does.

    Args:
        scratch: the folder that it may write.
        uid: the uid that it gets, if it is root's.

    Raises:
        SealError: the kernel refuses.
    """
    require_seal()
    readable = readable_folders()
    apart = separate(readable, scratch, uid)
    _leave_rights(uid if apart.reach else None)
    die_with_parent()
    _libc().prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_BYTES, MOST_BYTES))
    if apart.users:  # elsewhere it would count all processes of the user; the pool counts those of the run
        resource.setrlimit(resource.RLIMIT_NPROC, (MOST_PROCESSES, MOST_PROCESSES))
    restrict_files(readable, [scratch, *([Path(SHARED)] if apart.spaces else [])])
    try:
        restrict_calls(
            network=apart.spaces,
            ipc=apart.spaces,
            files=apart.spaces,
            signals=apart.pids or landlock_version() >= SIGNALS_SINCE,
        )
    except OSError as error:
        raise SealError(str(error)) from error
    if apart.pids:
        continue_inside()


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


def _libc() -> Any:
    return ctypes.CDLL(None, use_errno=True)
