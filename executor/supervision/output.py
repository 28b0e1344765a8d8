"""Converts the standard streams of a child to log messages; lines are truncated and limited in rate."""

from __future__ import annotations

import re
from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final

from executor.child_messages import Log

if TYPE_CHECKING:
    import asyncio
    from collections.abc import Callable

    from executor.messages import LogLevel

__all__ = ["LineReader", "RateLimit"]

LINE_CHARACTERS: Final = 4000
LINES_PER_S: Final = 200.0
LINES_BURST: Final = 1000
_CHUNK: Final = 1 << 16
_ROS_LINE: Final = re.compile(r"^\[(DEBUG|INFO|WARN|ERROR|FATAL)\] \[[\d.]+\] \[")
_ROS_LEVELS: Final[dict[str, LogLevel]] = {
    "DEBUG": "debug",
    "INFO": "info",
    "WARN": "warning",
    "ERROR": "error",
    "FATAL": "error",
}


@dataclass
class RateLimit:
    """A token bucket that counts the lines it drops."""

    per_s: float = LINES_PER_S
    burst: float = LINES_BURST
    held_back: int = 0
    _tokens: float = field(default=0.0, init=False)
    _at_s: float | None = field(default=None, init=False)

    def admits(self, now_s: float) -> bool:
        """Returns whether one more line may pass now."""
        if self._at_s is None:
            self._tokens, self._at_s = self.burst, now_s
        self._tokens = min(self.burst, self._tokens + (now_s - self._at_s) * self.per_s)
        self._at_s = now_s
        if self._tokens < 1:
            self.held_back += 1
            return False
        self._tokens -= 1
        return True

    def take_held_back(self) -> int:
        """Returns how many lines were dropped since the last call."""
        count, self.held_back = self.held_back, 0
        return count


class LineReader:
    """Reads one stream of a child until its end.

    Args:
        level: the level of lines that name none, unlike those of rclpy's logger.
        report: is called with each log message.
        clock: returns a monotonic time in s.
    """

    def __init__(self, level: LogLevel, report: Callable[[Log], None], clock: Callable[[], float]) -> None:
        self.last_lines: deque[str] = deque(maxlen=20)
        self._level = level
        self._report = report
        self._clock = clock
        self._limit = RateLimit()
        self._rest = b""

    async def read(self, stream: asyncio.StreamReader) -> None:
        """Reads until the end of the stream."""
        while chunk := await stream.read(_CHUNK):
            self.feed(chunk)
        if self._rest:
            self.feed(b"\n")

    def feed(self, chunk: bytes) -> None:
        """Adds a chunk of output, and reports the lines that are complete."""
        *lines, self._rest = (self._rest + chunk).split(b"\n")
        if len(self._rest) > LINE_CHARACTERS:
            lines.append(self._rest)
            self._rest = b""
        for line in lines:
            self._take(line[:LINE_CHARACTERS].decode(errors="replace").rstrip("\r"))

    def _take(self, text: str) -> None:
        self.last_lines.append(text)
        if not self._limit.admits(self._clock()):
            return
        if held_back := self._limit.take_held_back():
            self._report(Log("warning", f"… {held_back} lines were left out"))
        ros = _ROS_LINE.match(text)
        level = _ROS_LEVELS[ros.group(1)] if ros else self._level
        self._report(Log(level, text))
