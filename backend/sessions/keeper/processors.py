"""The processors on which containers with users' code run; the others stay free for the server."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

VARIABLE: Final = "BT_STUDIO_RESERVED_CPUS"
RESERVED_SHARE: Final = 4
"""One processor in so many is reserved by default. A weight alone does not protect the server: a request
wakes several processes in turn, and on busy processors each of them waits for the end of a time slice."""


def of_containers(environment: Mapping[str, str], available: Iterable[int] | None = None) -> tuple[int, ...]:
    """Returns the numbers of the processors for users' code, in ascending order.

    Args:
        environment: may have `BT_STUDIO_RESERVED_CPUS`.
        available: the processors of this machine; without it, those that this process may use.

    Raises:
        ValueError: the variable is no number, or leaves no processor; the text names it.
    """
    every = sorted(os.sched_getaffinity(0) if available is None else available)
    text = environment.get(VARIABLE, "").strip()
    if text and not text.isdecimal():
        raise ValueError(f"{VARIABLE}: {text!r} is not a number of processors")
    reserved = int(text) if text else len(every) // RESERVED_SHARE
    if reserved >= len(every):
        raise ValueError(f"{VARIABLE}: {reserved} of {len(every)} processors leave none for robots")
    return tuple(every[reserved:])
