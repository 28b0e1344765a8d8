"""The clock of a tree whose world runs in the same process."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from executor.world.interface import World

__all__ = ["WorldClock"]


class WorldClock:
    """Simulated time for Delay, Timeout and Sleep."""

    def __init__(self, world: World) -> None:
        self._world = world

    def now(self) -> float:
        """Returns the simulated time in s."""
        return self._world.time_s

    def sleep(self, duration_s: float) -> None:
        """Does nothing: simulated time does not pass within a tick."""
