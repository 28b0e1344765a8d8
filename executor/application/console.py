"""Captures standard output and error of the actions line by line, with the node that wrote each line."""

from __future__ import annotations

import io
import sys
import threading
import time
from typing import TYPE_CHECKING, Any, Final

from executor.child_messages import Log
from executor.supervision.channel import ChannelClosed
from executor.supervision.output import LINE_CHARACTERS, RateLimit

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.application.locate import Locator
    from executor.messages import LogLevel

__all__ = ["Console"]

_MAX_PENDING: Final = 1 << 16


class Console(io.TextIOBase):
    """Replaces `sys.stdout` or `sys.stderr`, and sends each line to the manager.

    Args:
        level: the log level of the lines.
        send: is called with each line.
        locator: finds the node whose action wrote a line.
        original: the replaced stream; the lines are written to it if the channel is closed, as in a process
            that an action forked.
        now_s: returns the simulated time in s; 0 while it is not known.
        clock: returns the time in s by which floods are cut.
    """

    def __init__(  # noqa: PLR0913 - a stream, and what replaces it
        self,
        level: LogLevel,
        send: Callable[[Log], None],
        locator: Locator,
        original: Any,
        now_s: Callable[[], float],
        *,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._level = level
        self._send = send
        self._locator = locator
        self._original = original
        self._now_s = now_s
        self._clock = clock
        self._pending = threading.local()
        self._limit = RateLimit()
        self._lock = threading.Lock()

    @property
    def encoding(self) -> str:  # type: ignore[override]
        """Always `utf-8`, whatever the encoding of the replaced stream."""
        return "utf-8"

    @property
    def buffer(self) -> Any:
        """The underlying binary stream (`buffer`) of the replaced stream."""
        return self._original.buffer

    def fileno(self) -> int:
        """Returns the descriptor of the replaced stream."""
        return int(self._original.fileno())

    def writable(self) -> bool:
        """Returns True."""
        return True

    def isatty(self) -> bool:
        """Returns False."""
        return False

    def write(self, text: str) -> int:
        """Buffers the text, sends each complete line, and returns the number of characters."""
        pending = getattr(self._pending, "text", "") + str(text)
        *lines, rest = pending.split("\n")
        if len(rest) > _MAX_PENDING:
            lines.append(rest)
            rest = ""
        self._pending.text = rest
        for line in lines:
            self._say(line)
        return len(text)

    def flush(self) -> None:
        """Sends the unfinished line that this thread has buffered, if there is one."""
        rest = getattr(self._pending, "text", "")
        if rest:
            self._pending.text = ""
            self._say(rest)

    def _say(self, line: str) -> None:
        with self._lock:
            if not self._limit.admits(self._clock()):
                return
            held_back = self._limit.take_held_back()
        if held_back:
            self._emit(f"… {held_back} lines were left out", None)
        self._emit(line[:LINE_CHARACTERS], self._locator.node_of(sys._getframe(2)))

    def _emit(self, line: str, node: Any) -> None:
        # The session's own time lags by up to a period of the world's reports.
        message = Log(self._level, line, time=self._now_s() or None)
        if node is not None:
            message.node_id, message.node_path = node.node_id, node.path
        try:
            self._send(message)
        except ChannelClosed:
            self._original.write(line + "\n")
            self._original.flush()
