"""The files that a sealed process, and all that it starts, may open."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from executor.supervision.landlock import (
    EXECUTE,
    IOCTL,
    LIST,
    READ,
    SIGNALS_SINCE,
    TRUNCATE,
    WRITE,
    LandlockError,
    every_right,
    landlock_version,
    restrict,
)

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["SIGNALS_SINCE", "SealError", "landlock_version", "restrict_files"]

DEVICES: Final = ("/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom")


class SealError(RuntimeError):
    """This platform cannot seal a process; the text says why."""


def restrict_files(readable: Iterable[Path], writable: Iterable[Path]) -> None:
    """Gives up all files but these and some devices; newer kernels also refuse TCP and signals.

    Raises:
        SealError: Landlock refuses.
    """
    allowed = [(path, EXECUTE | READ | LIST) for path in readable]
    allowed += [(path, every_right() & ~IOCTL) for path in writable]
    allowed += [(Path(name), READ | WRITE | TRUNCATE) for name in DEVICES]
    try:
        restrict(allowed)
    except LandlockError as error:
        raise SealError(str(error)) from error
