"""The one deadline of tests that wait: it costs time only where a test fails."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["DEADLINE_S", "wait_until"]

DEADLINE_S: Final = 120.0
T = TypeVar("T")


def wait_until(
    true: Callable[[], T], what: str, *, deadline_s: float = DEADLINE_S, every_s: float = 0.05
) -> T:
    """Waits for `true()` and returns its value; the error names the condition that was not met."""
    end_s = time.monotonic() + deadline_s
    while not (found := true()):
        assert time.monotonic() < end_s, f"after {deadline_s:g} s still not: {what}"
        time.sleep(every_s)
    return found
