"""Derives simulated time from real time. Time is an argument."""

from __future__ import annotations

import math
from typing import Final

FREE_RUN: Final = 0.0
LARGEST_DELAY_S: Final = 0.1
FREE_RUN_STEPS: Final = 48


class Pacer:
    """Computes the number of steps that are due. After a stall, at most `LARGEST_DELAY_S` is caught up."""

    def __init__(self, step_s: float, speed: float = 1.0) -> None:
        self._step_s = step_s
        self._speed = speed
        self._anchor_s: float | None = None
        self._taken = 0

    @property
    def speed(self) -> float:
        """Simulated seconds for each second of real time; 0 is as fast as the machine can."""
        return self._speed

    def set_speed(self, speed: float) -> None:
        """Changes the speed from now on. It must be finite and not negative."""
        if not math.isfinite(speed) or speed < 0:
            raise ValueError("a speed is a number from 0 on")
        self._speed = speed
        self._anchor_s = None

    def pause(self) -> None:
        """Pauses: real time from now until the next call of `due` is ignored."""
        self._anchor_s = None

    def due(self, now_s: float) -> int:
        """Returns the number of steps that are due, and counts them as done."""
        if self._speed == FREE_RUN:
            return FREE_RUN_STEPS
        if self._anchor_s is None:
            self._anchor_s, self._taken = now_s, 0
        wanted = (now_s - self._anchor_s) * self._speed / self._step_s
        steps = int(wanted + 1e-9) - self._taken
        most = max(1, int(LARGEST_DELAY_S * max(self._speed, 1.0) / self._step_s))
        if steps > most:
            self._anchor_s, self._taken = now_s, 0
            return most
        self._taken += steps
        return steps

    def next_due_s(self, now_s: float, steps: int) -> float:
        """Returns the seconds until `steps` further steps are due."""
        if self._speed == FREE_RUN or self._anchor_s is None:
            return 0.0
        at = self._anchor_s + (self._taken + steps) * self._step_s / self._speed
        return max(0.0, at - now_s)
