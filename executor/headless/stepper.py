"""Steps a world in the order of lock-step: its sensors measure at their rates, as in real time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.ros.node import WorldNode
    from executor.world.interface import World
    from executor.world.sensing.sensors import Sensors
    from executor.world.simulation.loop import Part

__all__ = ["PERIOD_STEPS", "Stepper"]

PERIOD_STEPS: Final = 4  # steps between polls of the world's topics, as in real time


class Stepper:
    """Simulates a world in parts of at most one period.

    How the steps are spread over calls has no effect on the world: a part always ends at the same steps.

    Attributes:
        parts: work beside the world, on its time.
        moved: called after each part; what it raises ends the run.
        published: called after sensors were published.
    """

    def __init__(self, world: World, sensors: Sensors, node: WorldNode) -> None:
        self._world = world
        self._sensors = sensors
        self._node = node
        self.parts: list[Part] = []
        self.moved: Callable[[], None] = lambda: None
        self.published: Callable[[], None] = lambda: None

    @property
    def done(self) -> int:
        """The number of steps since the world's time 0."""
        return round(self._world.time_s / self._world.step_s)

    def publish(self) -> None:
        """Publishes what the sensors measure now."""
        self._node.publish(self._sensors)

    def count(self, until_step: int) -> int:
        """Returns the number of steps of the next part on the way to a step."""
        done = self.done
        return min(until_step - done, PERIOD_STEPS - done % PERIOD_STEPS)

    def advance(self, until_step: int) -> None:
        """Simulates the next part on the way to a step."""
        done = self.done
        count = min(until_step - done, PERIOD_STEPS - done % PERIOD_STEPS)
        self._world.step(count)
        self.moved()
        done += count
        self._sensors.changed()
        if done % PERIOD_STEPS == 0 or done == until_step:
            for part in self.parts:
                part.poll()
            self.publish()
            self.published()
