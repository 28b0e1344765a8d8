"""Budgets of processor time in this process: an owner who exceeds their share must wait while others work.

An interpreter runs one thread at a time, so requests, heads and frames of all users take turns. A fair queue
alone is not enough: an owner who always has an item in it gets every other turn.

The rule is the *generic cell rate algorithm* (ITU-T I.371, annex A). Each owner has a time from which they
may continue. Using processor time moves it into the future by used / share; a burst may be used in advance.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

SHARE: Final = 0.15
"""Share of one processor for each owner who has used up their burst."""
BURST_S: Final = 0.3
"""Seconds of processor time that may be used in advance; opening a page takes a tenth of it."""
LONGEST_REST_S: Final = 2.0
OTHERS_S: Final = 2.0
"""Seconds.

An owner waits only if another owner was active in this time, so that no owner waits for an idle server.
"""
MOST_OWNERS: Final = 10_000


class Budgets:
    """Stores the processor time that owners have used, and computes how long each must wait.

    Only the event loop's thread uses it.

    Args:
        share: fraction of a processor for one owner.
        burst_s: seconds of processor time that may be used in advance.
        clock: returns a monotonic time in seconds.
    """

    def __init__(
        self,
        *,
        share: float = SHARE,
        burst_s: float = BURST_S,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._share, self._burst_s, self._clock = share, burst_s, clock
        self._free_at_s: dict[str, float] = {}
        self._latest, self._latest_s = "", float("-inf")
        self._other_s = float("-inf")

    def spend(self, owner: str, used_s: float) -> float:
        """Charges processor time to an owner.

        Returns the seconds that the owner's next piece of work must wait.

        Each piece delays the next one further, so that many connections of one owner do not all continue at
        the same moment.
        """
        now_s = self._clock()
        if owner != self._latest:
            self._latest, self._other_s = owner, self._latest_s
        self._latest_s = now_s
        if len(self._free_at_s) > MOST_OWNERS:
            self._free_at_s = {
                name: at for name, at in self._free_at_s.items() if at > self._earliest_s(now_s)
            }
        free_at_s = max(self._free_at_s.get(owner, float("-inf")), self._earliest_s(now_s))
        self._free_at_s[owner] = min(free_at_s + used_s / self._share, now_s + LONGEST_REST_S)
        return self.rest_s(owner)

    def rest_s(self, owner: str) -> float:
        """Returns the seconds that the owner's next piece of work must wait; 0.0 for most owners."""
        now_s = self._clock()
        other_s = self._other_s if owner == self._latest else self._latest_s
        if now_s - other_s > OTHERS_S:
            return 0.0
        return max(0.0, self._free_at_s.get(owner, now_s) - now_s)

    def _earliest_s(self, now_s: float) -> float:
        return now_s - self._burst_s / self._share


budgets: Final = Budgets()
"""The budgets of this process."""
