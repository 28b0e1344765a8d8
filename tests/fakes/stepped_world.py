"""A world, its sensors and its node that write down in which order they are used; there is no physics."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

STEP_S = 1 / 240


class SteppedWorld:
    """Counts steps. `log` holds all that happened, as tuples with the number of the step."""

    def __init__(self, log: list[Any] | None = None) -> None:
        self.log: list[Any] = [] if log is None else log
        self.steps = 0
        self.step_s = STEP_S
        self.robots: list[Any] = []

    @property
    def time_s(self) -> float:
        return self.steps * STEP_S

    def step(self, count: int = 1) -> None:
        self.steps += count
        self.log.append(("step", self.steps))

    def reset(self) -> None:
        self.steps = 0
        self.log.append(("reset", 0))

    def take_collisions(self) -> list[Any]:
        return []


class SteppedNode:
    """Notes each look at commands and each publication."""

    def __init__(self, world: SteppedWorld) -> None:
        self._world = world

    def poll(self) -> None:
        self._world.log.append(("poll", self._world.steps))

    def awaits_publisher(self, _now_s: float) -> bool:
        return False

    def publish(self, _sensors: Any) -> None:
        self._world.log.append(("publish", self._world.steps))

    def publish_clock(self) -> None:
        self._world.log.append(("clock", self._world.steps))

    def restart(self) -> None:
        self._world.log.append(("restart", self._world.steps))

    def take_notes(self) -> list[str]:
        return []

    def wants_pictures(self) -> bool:
        return False


def stepped_sensors() -> Any:
    """Returns sensors that measure nothing."""
    return SimpleNamespace(changed=lambda: None, load_scene=lambda: None, version=0)
