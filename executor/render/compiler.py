"""Releases the memory of the shader compiler, which a software renderer needs rarely."""

from __future__ import annotations

import ctypes
import logging
import re
from pathlib import Path
from typing import Final

_log = logging.getLogger(__name__)

_CODE: Final = re.compile(r"^([0-9a-f]+)-([0-9a-f]+) r-xp \S+ \S+ \S+ +(/\S*libLLVM\S*)$", re.MULTILINE)
_MADV_DONTNEED: Final = 4


def release_compiler() -> int:
    """Drops the code of the shader compiler from this process's memory.

    Returns the bytes of address space that it covers.

    Only unmodified pages of code are dropped: the kernel loads them again from the file when they are needed.
    Pages that the loader has written are kept.
    """
    try:
        maps = Path("/proc/self/maps").read_text(encoding="utf-8")
        libc = ctypes.CDLL(None, use_errno=True)
    except OSError as error:  # not Linux, or no /proc
        _log.debug("The compiler's pages stay: %s", error)
        return 0
    total = 0
    for begin, end, _ in _CODE.findall(maps):
        first, length = int(begin, 16), int(end, 16) - int(begin, 16)
        if libc.madvise(ctypes.c_void_p(first), ctypes.c_size_t(length), _MADV_DONTNEED) == 0:
            total += length
    return total
