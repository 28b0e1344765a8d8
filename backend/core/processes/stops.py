"""Work in another process or container that can be ended before it is done."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable


class StoppedError(Exception):
    """The work was ended before it began; its client has left, or asked for that."""


class Stop:
    """Ends work, also if it has not begun."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._is_set = False
        self._end: Callable[[], None] | None = None

    def bind(self, end: Callable[[], None]) -> None:
        """Takes what ends the work.

        Raises:
            StoppedError: the work was ended before.
        """
        with self._lock:
            self._end = end
            if not self._is_set:
                return
        raise StoppedError

    def set(self) -> None:
        """Ends the work."""
        with self._lock:
            self._is_set = True
            if self._end is not None:
                self._end()

    def release(self) -> None:
        """Forgets what ends the work, which is over: its number may soon be that of another process."""
        with self._lock:
            self._end = None
