"""Measures how long something has been as it is, by a clock that does not jump.

The rows of the database have wall-clock times, and a wall clock can be set by hours while sessions are used.
So each process notes when it first saw a value, and counts from there by its monotonic clock. The time in the
row only says how old a value was when it was seen first.
"""

from __future__ import annotations

import threading
import time
from datetime import UTC, datetime, timedelta
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from uuid import UUID

JUMP_S: Final = 5.0
"""Seconds by which the wall clock may differ from the monotonic clock between two looks."""


class _Seen(NamedTuple):
    at: datetime
    began_s: float


class Ages:
    """The ages of values with a time, by key.

    Args:
        wall: returns the wall-clock time.
        steady: returns the time of a monotonic clock in seconds.
    """

    def __init__(
        self,
        wall: Callable[[], datetime] = lambda: datetime.now(UTC),
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        self._wall, self._steady = wall, steady
        self._lock = threading.Lock()
        self._last: tuple[datetime, float] | None = None
        self._seen: dict[UUID, _Seen] = {}

    def of(
        self, times: Mapping[UUID, datetime], *, at_first: timedelta | None = None
    ) -> dict[UUID, timedelta]:
        """Returns the age of each value.

        A value whose time is another than at the last look is a new one.

        Args:
            times: the time of each value; other keys are forgotten.
            at_first: the greatest age of a key that was not there at the last look.
        """
        with self._lock:
            wall, steady = self._wall(), self._steady()
            has_jumped = self._has_jumped(wall, steady)
            self._last = (wall, steady)
            seen: dict[UUID, _Seen] = {}
            for key, at in times.items():
                before = self._seen.get(key)
                if before is not None and before.at == at:
                    seen[key] = before
                    continue
                age_s = 0.0 if has_jumped else max(0.0, (wall - at).total_seconds())
                if before is None and at_first is not None:
                    age_s = min(age_s, at_first.total_seconds())
                seen[key] = _Seen(at, steady - age_s)
            self._seen = seen
            return {key: timedelta(seconds=steady - found.began_s) for key, found in seen.items()}

    def _has_jumped(self, wall: datetime, steady: float) -> bool:
        if self._last is None:
            return False
        return abs((wall - self._last[0]).total_seconds() - (steady - self._last[1])) > JUMP_S
