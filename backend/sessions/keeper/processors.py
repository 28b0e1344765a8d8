"""The processors on which containers with users' code run; the others are reserved for the server."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

VARIABLE: Final = "BT_STUDIO_RESERVED_CPUS"
RESERVED_SHARE: Final = 4
"""By default, one of so many processors is reserved for the server.

A weight alone does not protect the server: a request wakes several processes in turn, and on busy processors
each of them waits for the end of a time slice.
"""


def of_containers(environment: Mapping[str, str], available: Iterable[int] | None = None) -> tuple[int, ...]:
    """Returns the numbers of the processors for users' code, in ascending order.

    Args:
        environment: the variables; `BT_STUDIO_RESERVED_CPUS` may be one of them.
        available: the processors of this machine; with None, those that this process may use.

    Raises:
        ValueError: the variable is not a number, or reserves every processor; the text names it.
    """
    every = sorted(os.sched_getaffinity(0) if available is None else available)
    text = environment.get(VARIABLE, "").strip()
    if text and not text.isdecimal():
        raise ValueError(f"{VARIABLE}: {text!r} is not a number of processors")
    reserved = int(text) if text else len(every) // RESERVED_SHARE
    if reserved >= len(every):
        raise ValueError(f"{VARIABLE}: {reserved} of {len(every)} processors leave none for robots")
    return tuple(every[reserved:])
