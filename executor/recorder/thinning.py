"""Thins topics that send more than a recording should hold. Pure; time is an argument."""

from __future__ import annotations

from typing import Final, NamedTuple

__all__ = ["MOST_BYTES_PER_S", "Thinner", "Verdict"]

MOST_BYTES_PER_S: Final = 200_000


class Verdict(NamedTuple):
    """Whether a message is kept, and a sentence at the first one of a topic that is not."""

    is_kept: bool
    note: str = ""


_KEPT: Final = Verdict(is_kept=True)
_LEFT_OUT: Final = Verdict(is_kept=False)


class Thinner:
    """Keeps at most 200 KB of each topic in each simulated second, and at least one message."""

    def __init__(self) -> None:
        self._used: dict[str, tuple[int, int]] = {}
        self._noted: set[str] = set()

    def take(self, topic: str, now_s: float, size: int) -> Verdict:
        """Decides about a message of `size` bytes."""
        second, used = self._used.get(topic, (-1, 0))
        if int(now_s) != second:
            second, used = int(now_s), 0
        if used and used + size > MOST_BYTES_PER_S:
            if topic in self._noted:
                return _LEFT_OUT
            self._noted.add(topic)
            note = (
                f"{topic} sends more than {MOST_BYTES_PER_S // 1000} KB/s; the recording holds a part of it."
            )
            return Verdict(is_kept=False, note=note)
        self._used[topic] = second, used + size
        return _KEPT
