"""The most that a file from outside may hold."""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Self

from executor.recorder.outside.errors import OutsideError
from executor.recorder.reader import Limits

if TYPE_CHECKING:
    from executor.recorder.outside.errors import Code

__all__ = ["Counter"]


@dataclass
class Counter:
    """Counts what was read of a file, against the limits.

    Args:
        name: the name of the file in errors.
        limits: the largest permitted sizes and counts.
        seconds: how long reading may take.
    """

    name: str
    limits: Limits = field(default_factory=Limits)
    seconds: float = 55.0
    _messages: int = 0
    _bytes: int = 0
    _end_s: float = 0.0

    def __post_init__(self) -> None:
        self._end_s = self._end_s or time.monotonic() + self.seconds

    def add(self, size: int, place: int) -> None:
        """Counts a message or row of so many bytes.

        Raises:
            OutsideError: there are too many, or it takes too long.
        """
        self._messages += 1
        self._bytes += size
        if self._messages > self.limits.messages:
            raise self.error(
                "too_large",
                place,
                "the file has too many messages",
                f"At most {self.limits.messages} are read.",
            )
        if self._bytes > self.limits.total_bytes:
            raise self.error(
                "too_large",
                place,
                "the file is too large unpacked",
                f"At most {self.limits.total_bytes} bytes.",
            )
        if self._messages % 1000 == 0 and self.is_late():
            raise self.late(place)

    def again(self) -> Self:
        """Returns a counter from 0 for another pass over the file; the time that is left stays."""
        return replace(self, _messages=0, _bytes=0)

    def is_late(self) -> bool:
        """Returns whether reading took too long."""
        return time.monotonic() > self._end_s

    def late(self, place: int) -> OutsideError:
        """Returns the error for a file that takes too long."""
        text = f"reading took more than {self.seconds:g} s"
        return self.error("too_long", place, text, "Cut the part of the log that matters.")

    def error(self, code: Code, place: int, message: str, hint: str) -> OutsideError:
        """Returns an error of the file."""
        return OutsideError(code, self.name, place, message, hint)
