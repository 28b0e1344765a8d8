"""Interrupts the main thread while it hangs, when the manager sends a signal."""

from __future__ import annotations

import signal
from typing import TYPE_CHECKING

from executor.supervision.confine import INTERRUPT_SIGNAL

if TYPE_CHECKING:
    from types import FrameType

    from executor.application.locate import Locator, Place

__all__ = ["Breaker", "Interrupted"]


class Interrupted(BaseException):
    """Raised in a main thread that hangs. It is not an `Exception`, since actions may catch those."""

    def __init__(self, place: Place) -> None:
        super().__init__("interrupted")
        self.place = place


class Breaker:
    """Handles the manager's signal during a run."""

    def __init__(self, locator: Locator) -> None:
        self._locator = locator
        self._is_armed = False
        self.is_interrupted = False

    def arm(self) -> None:
        """Starts to interrupt the user's code on the signal. Call it on the main thread."""
        self._is_armed = True
        signal.signal(INTERRUPT_SIGNAL, self._interrupt)

    def disarm(self) -> None:
        """Stops interrupting on the signal."""
        self._is_armed = False

    def _interrupt(self, _number: int, frame: FrameType | None) -> None:
        self.is_interrupted = True
        place = self._locator.place_of(frame)
        if place.is_in_action and self._is_armed:
            raise Interrupted(place)
