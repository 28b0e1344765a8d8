"""Clocks, and the timers of a tree. Time is an argument."""

import heapq
import itertools
import time
from collections.abc import Callable
from typing import Protocol


class Clock(Protocol):
    """A source of time that can also wait."""

    def now(self) -> float:
        """Returns the seconds since a fixed moment; they never decrease."""

    def sleep(self, duration_s: float) -> None:
        """Waits for this many seconds."""


class SystemClock:
    """The clock of the computer."""

    def now(self) -> float:
        """Returns the seconds since a fixed moment."""
        return time.monotonic()

    def sleep(self, duration_s: float) -> None:
        """Waits for this many seconds."""
        time.sleep(duration_s)


class ManualClock:
    """Time that passes only in `sleep`, for tests and lock-step runs."""

    def __init__(self, now_s: float = 0.0) -> None:
        self._now_s = now_s

    def now(self) -> float:
        """Returns the seconds since the start at zero."""
        return self._now_s

    def sleep(self, duration_s: float) -> None:
        """Advances the time without waiting."""
        self._now_s += duration_s

    advance = sleep


class Timer:
    """One call that is scheduled for a time; `owner` is the user's object that started it, if one did."""

    __slots__ = ("callback", "deadline_s", "owner")

    def __init__(self, deadline_s: float, callback: Callable[[], None], owner: object = None) -> None:
        self.deadline_s = deadline_s
        self.callback: Callable[[], None] | None = callback
        self.owner = owner

    def cancel(self) -> None:
        """Cancels the call."""
        self.callback = None


class Timers:
    """The timers of one tree. The tree fires those that are due before each tick, and while it sleeps."""

    __slots__ = ("_order", "clock", "heap")

    def __init__(self, clock: Clock) -> None:
        self.clock = clock
        # Public, so that each tick can test without a call whether anything is due.
        self.heap: list[tuple[float, int, Timer]] = []
        self._order = itertools.count()

    def start(self, delay_s: float, callback: Callable[[], None], owner: object = None) -> Timer:
        """Schedules a call of `callback` after `delay_s` seconds."""
        timer = Timer(self.clock.now() + delay_s, callback, owner)
        heapq.heappush(self.heap, (timer.deadline_s, next(self._order), timer))
        return timer

    def restore(self, timer: Timer, order: int) -> None:
        """Schedules a timer of another tree at the place among equal deadlines that it had there."""
        heapq.heappush(self.heap, (timer.deadline_s, order, timer))
        self._order = itertools.count(max(order + 1, next(self._order)))

    def fire(self) -> None:
        """Makes the calls whose deadline has passed, in the order of their deadlines."""
        # A tolerance, because seconds in floats do not add up: three times 0.1 s is 0.30000000000000004 s.
        now_s = self.clock.now() + 1e-9
        while self.heap and self.heap[0][0] <= now_s:
            callback = heapq.heappop(self.heap)[2].callback
            if callback is not None:
                callback()

    def next_s(self) -> float | None:
        """Returns the time at which the next call is due, or None."""
        while self.heap and self.heap[0][2].callback is None:
            heapq.heappop(self.heap)
        return self.heap[0][0] if self.heap else None
