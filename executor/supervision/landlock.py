"""Landlock (Linux 5.13): a process gives up all files outside of some folders, for itself and its children.

It holds for the thread that calls it and what this starts, so a process calls it while it has one thread.
Newer kernels also refuse TCP and signals to processes outside.
"""

from __future__ import annotations

import ctypes
import os
import struct
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

EXECUTE, WRITE, READ, LIST, TRUNCATE, IOCTL = 1, 2, 4, 8, 1 << 14, 1 << 15
_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_UNDER_PATH: Final = 1
_FS_BITS: Final = {1: 13, 2: 14, 3: 15, 4: 15}
"""The number of rights of files by the version of Landlock; 16 from version 5 on."""
SIGNALS_SINCE: Final = 6
"""The version of Landlock that refuses signals to processes outside."""
_NET: Final = 3
_SCOPES: Final = 3
_PR_SET_NO_NEW_PRIVS: Final = 38


class LandlockError(RuntimeError):
    """The kernel refuses a rule."""


def landlock_version() -> int:
    """Returns the version of the kernel's Landlock; 0 if it has none."""
    return max(0, int(_libc().syscall(_CREATE_RULESET, None, ctypes.c_size_t(0), ctypes.c_uint32(1))))


def every_right() -> int:
    """Returns all rights of files that this kernel's Landlock knows."""
    return (1 << _FS_BITS.get(landlock_version(), 16)) - 1


def restrict(allowed: Iterable[tuple[Path, int]]) -> None:
    """Gives up all rights of files except these, by folder or file; those that do not exist are left out.

    Raises:
        LandlockError: the kernel refuses.
    """
    version, every = landlock_version(), every_right()
    parts = [every, _NET if version >= 4 else 0, _SCOPES if version >= SIGNALS_SINCE else 0]
    attributes = struct.pack("QQQ", *parts)[: 8 if version < 4 else 16 if version < SIGNALS_SINCE else 24]
    libc = _libc()
    libc.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    rules = int(libc.syscall(_CREATE_RULESET, attributes, ctypes.c_size_t(len(attributes)), 0))
    if rules < 0:
        raise LandlockError("Landlock refuses")
    try:
        for path, rights in allowed:
            _allow(rules, path, rights & every)
        if libc.syscall(_RESTRICT_SELF, rules, 0) != 0:
            raise LandlockError("Landlock refuses")
    finally:
        os.close(rules)


def _allow(rules: int, path: Path, rights: int) -> None:
    try:
        handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
    except FileNotFoundError:
        return
    try:
        if not path.is_dir():
            rights &= EXECUTE | READ | WRITE | TRUNCATE
        rule = struct.pack("=Qi", rights, handle)
        if _libc().syscall(_ADD_RULE, rules, _UNDER_PATH, rule, 0) != 0:
            raise LandlockError(f"Landlock refuses a rule for {path}")
    finally:
        os.close(handle)


def _libc() -> Any:
    return ctypes.CDLL(None, use_errno=True)
