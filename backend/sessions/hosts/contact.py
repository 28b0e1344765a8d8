"""For how long a host has not been heard, as the web server counts that maintains the sessions.

Only failed looks count, each for at most a few seconds: a web server that was stopped, or that has just begun
to maintain the sessions, has missed nothing.
"""

from __future__ import annotations

from typing import Final

__all__ = ["LOST_S", "Contact"]

LOST_S: Final = 30.0
"""Seconds without contact after which a host is lost."""
_LONGEST_LOOK_S: Final = 10.0
_FORGOTTEN_S: Final = 20.0
"""Seconds between two looks after which counting begins again."""


class Contact:
    """The contact with one host; each time is one of a clock that never goes back."""

    def __init__(self) -> None:
        self.silent_s = 0.0
        self._looked_s: float | None = None
        self._is_missed = False

    @property
    def is_lost(self) -> bool:
        """Whether the host was given up."""
        return self.silent_s >= LOST_S

    def heard(self, now_s: float) -> bool:
        """Notes an answer; returns whether the host was missed before."""
        was_missed, self._is_missed = self._is_missed, False
        self.silent_s, self._looked_s = 0.0, now_s
        return was_missed

    def missed(self, now_s: float) -> None:
        """Notes a look without an answer."""
        before_s = self._looked_s
        if before_s is None or now_s - before_s > _FORGOTTEN_S:
            self.silent_s = 0.0
        else:
            self.silent_s += min(now_s - before_s, _LONGEST_LOOK_S)
        self._looked_s, self._is_missed = now_s, True
