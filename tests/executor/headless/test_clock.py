"""The clock of a tree in lock-step is that of its world."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from executor.headless.clock import WorldClock


def test_it_tells_simulated_time_and_nothing_passes_in_a_sleep() -> None:
    world: Any = SimpleNamespace(time_s=1.5)
    clock = WorldClock(world)
    clock.sleep(10.0)
    assert clock.now() == 1.5
    world.time_s = 2.0
    assert clock.now() == 2.0
