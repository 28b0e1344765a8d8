"""Clocks, and the timers of a tree."""

from __future__ import annotations

import time

from tree_gardener.clock import ManualClock, SystemClock, Timers


def test_timers_fire_in_the_order_of_their_deadlines() -> None:
    clock = ManualClock()
    timers, fired = Timers(clock), list[str]()
    timers.start(0.2, lambda: fired.append("late"))
    timers.start(0.1, lambda: fired.append("early"))
    cancelled = timers.start(0.05, lambda: fired.append("never"))
    cancelled.cancel()
    assert timers.next_s() == 0.1
    for _ in range(2):
        clock.advance(0.1)
        timers.fire()
    assert fired == ["early", "late"]
    assert timers.next_s() is None


def test_sums_of_tenths_are_due_in_time() -> None:
    clock = ManualClock()
    timers, fired = Timers(clock), list[int]()
    timers.start(0.3, lambda: fired.append(1))
    for _ in range(3):
        clock.sleep(0.1)
    timers.fire()
    assert fired == [1]


def test_the_computers_clock_never_goes_back() -> None:
    before = time.monotonic()
    assert before <= SystemClock().now() <= time.monotonic()
