"""Notices from outside that the main thread does not come back, and breaks it off when asked."""

from __future__ import annotations

import signal
import sys
import threading
import time
from typing import TYPE_CHECKING, Any, Final

from executor.supervision.channel import ChannelClosed
from executor.supervision.confine import INTERRUPT_SIGNAL

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import FrameType

    from executor.application.locate import Locator, Place

__all__ = ["Interrupted", "Watchdog"]

HEARTBEAT_AFTER_S: Final = 0.5
FAULT_AFTER_S: Final = 2.0
INTERVAL_S: Final = 0.1


class Interrupted(BaseException):
    """Raised in the main thread where it hangs; actions do not catch it by accident."""

    def __init__(self, place: Place) -> None:
        super().__init__("interrupted")
        self.place = place


class Watchdog:
    """Watches that `alive` is called again and again on the main thread.

    Args:
        locator: names the node.
        on_hang: called once for each hang, on the watchdog's thread.
        send: takes `heartbeat` messages while the main thread is away.
    """

    def __init__(
        self,
        locator: Locator,
        on_hang: Callable[[str, Place], None],
        send: Callable[[dict[str, Any]], None],
    ) -> None:
        self._locator = locator
        self._on_hang = on_hang
        self._send = send
        self._main = threading.main_thread().ident or 0
        self._alive_s = time.monotonic()
        self._is_watching = False
        self._was_told = False
        self.is_interrupted = False

    def start(self) -> None:
        """Starts to watch. Call it on the main thread."""
        self.alive()
        self._is_watching = True
        signal.signal(INTERRUPT_SIGNAL, self._interrupt)
        threading.Thread(target=self._watch, name="watchdog", daemon=True).start()

    def stop(self) -> None:
        """Watches no more."""
        self._is_watching = False

    def alive(self) -> None:
        """The main thread is between two pieces of work."""
        self._alive_s = time.monotonic()
        self._was_told = False

    def _interrupt(self, _number: int, frame: FrameType | None) -> None:
        self.is_interrupted = True
        place = self._locator.place_of(frame)
        if place.is_in_action and self._is_watching:
            raise Interrupted(place)

    def _watch(self) -> None:
        told_s = 0.0
        while self._is_watching:
            time.sleep(INTERVAL_S)
            away_s = time.monotonic() - self._alive_s
            if away_s < HEARTBEAT_AFTER_S or time.monotonic() < told_s + HEARTBEAT_AFTER_S:
                continue
            told_s = time.monotonic()
            place = self._locator.place_of(sys._current_frames().get(self._main))
            try:
                self._send({"type": "heartbeat", "in_tick_node": str(place) if place.is_in_action else ""})
                if away_s >= FAULT_AFTER_S and not self._was_told and place.is_in_action:
                    self._was_told = True
                    self._on_hang(f"{place} has not returned for {away_s:.0f} s", place)
            except ChannelClosed:
                return
