"""The loop of a world whose tree ticks in the same process: sensors, then the tick, then the actuators.

Real time decides only how fast the loop continues, never what happens: steps and ticks follow each other in
the order of a lock-step run. Time waits for a slow tick.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from executor.headless.stepper import PERIOD_STEPS
from executor.world.simulation.loop import IDLE_CLOCK_S, SimulationLoop

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.headless.stepper import Stepper
    from executor.ros.node import WorldNode
    from executor.world.interface import World
    from executor.world.sensing.sensors import Sensors
    from executor.world.simulation.loop import Send

__all__ = ["ExactLoop"]


class ExactLoop(SimulationLoop):
    """Steps a world at its pace, and lets the tree tick at its steps. It starts paused.

    Args:
        world: the world.
        sensors: its sensors.
        node: its ROS node.
        send: is called with each event and frame.
        stepper: steps the world.
        tick: lets callbacks and tree do what is due now.
        is_ticking: whether the tree ticks; the world stops before a tick while it does not.
        tick_hz: the ticks in a second of simulated time.
        speed: the simulated seconds for each second of real time.
        sleep: waits for a real time in s.
    """

    def __init__(  # noqa: PLR0913 - a world, and the tree in it
        self,
        world: World,
        sensors: Sensors,
        node: WorldNode,
        send: Send,
        *,
        stepper: Stepper,
        tick: Callable[[], None],
        is_ticking: Callable[[], bool],
        tick_hz: float,
        speed: float = 1.0,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        super().__init__(world, sensors, node, send, speed=speed)
        self._stepper = stepper
        self._tick = tick
        self._is_ticking = is_ticking
        self._sleep = sleep
        self._tick_hz = tick_hz
        self._base_step = stepper.done
        self._number = self._ticks = 0
        self._credit = 0
        self._last_tick_step = stepper.done
        self.rests_after_tick: Callable[[], bool] = lambda: False
        """Whether the loop does nothing more for now just after a tick."""
        self._is_fresh = True
        """Whether the sensors have not published anything for the next tick."""

    @property
    def next_tick_step(self) -> int:
        """The step before which the next tick is due."""
        return self._base_step + round(self._number / self._tick_hz / self._world.step_s)

    def set_tick_rate(self, tick_hz: float) -> None:
        """Changes the rate of ticks after the last one."""
        if self._number:
            self._number -= 1
            self._base_step, self._number = self.next_tick_step, 1
        self._tick_hz = tick_hz

    @property
    def ticks(self) -> int:
        """The number of ticks that were begun, since the loop was made."""
        return self._ticks

    @property
    def step_number(self) -> int:
        """The present step of the world."""
        return self._stepper.done

    @property
    def is_at_tick(self) -> bool:
        """Whether nothing was simulated since the last tick, or since the begin."""
        return self._stepper.done == self._last_tick_step

    @property
    def time_s(self) -> float:
        """The simulated time in s."""
        return self._world.time_s

    @property
    def speed(self) -> float:
        """The simulated seconds for each second of real time; 0 for as fast as possible."""
        return self._pacer.speed

    @property
    def tick_hz(self) -> float:
        """The ticks in a second of simulated time."""
        return self._tick_hz

    def tick(self) -> None:
        """Simulates up to the next tick of the tree, and makes it."""
        self.run_to_tick(lambda: None)

    def run_to_tick(self, between: Callable[[], None]) -> None:
        """Simulates up to the next tick of the tree, and makes it; calls `between` before each part of it."""
        between()
        while self._stepper.done < self.next_tick_step:
            self._stepper.advance(self.next_tick_step)
            self._told_time()
            between()
        self._make_tick()

    def run_to_step(self, step: int) -> None:
        """Simulates up to a step, at most to the next tick, which is not made."""
        while self._stepper.done < min(step, self.next_tick_step):
            self._stepper.advance(self.next_tick_step)
            self._told_time()

    def let_time_pass(self) -> None:
        """Simulates for one period at the pace of the world, while an action waits in rclpy."""
        until = self._stepper.done + PERIOD_STEPS
        while self._stepper.done < until:
            self._stepper.advance(until)
        self._node.poll()
        if self._pacer.speed > 0:
            self._sleep(PERIOD_STEPS * self._world.step_s / self._pacer.speed)
        self.streams.send_due(time.monotonic())

    def resume(self) -> None:
        """Resumes simulated time."""
        self._credit = 0
        super().resume()

    def step(self, dt_s: float) -> None:
        """Simulates up to the next tick, which is not made; `dt_s` is the period of the ticks."""
        while self._stepper.done < self.next_tick_step:
            self._stepper.advance(self.next_tick_step)
        self._tell()

    def reset(self) -> None:
        """Resets the world; a paused world stays paused."""
        super().reset()
        self._base_step = self._number = self._credit = self._last_tick_step = 0
        self._is_fresh = True

    def next_due_s(self, now_s: float) -> float:
        """Returns the seconds until `run_due` has something to do."""
        if self.is_paused or self._waits:
            return min(IDLE_CLOCK_S, self.streams.next_due_s(now_s))
        if self._is_tick_due:
            return 0.0
        return self._pacer.next_due_s(now_s, max(0, self._stepper.count(self.next_tick_step) - self._credit))

    @property
    def _is_tick_due(self) -> bool:
        return self._stepper.done >= self.next_tick_step

    @property
    def _waits(self) -> bool:
        """Whether a tick is due, and the tree does not tick."""
        return self._is_tick_due and not self._is_ticking()

    def _idle(self, now_s: float) -> None:
        """Does nothing: no other process needs the time, and nothing may happen between two steps."""

    def _advance(self, steps: int) -> None:
        self._credit += steps
        while not self.is_paused and not self._waits:
            if self._is_tick_due:
                self._make_tick()
                if self.rests_after_tick():
                    break
                continue
            count = self._stepper.count(self.next_tick_step)
            if count > self._credit:
                break
            self._credit -= count
            self._stepper.advance(self.next_tick_step)
            self._told_time()
        else:
            self._credit = 0
        self._tell()

    def _make_tick(self) -> None:
        if self._is_fresh:
            self._is_fresh = False
            self._stepper.publish()
        self._number += 1
        self._ticks += 1
        self._last_tick_step = self._stepper.done
        self._tick()
        self._node.poll()
        self._told_time()

    def _tell(self) -> None:
        self._tell_collisions()
        for note in self._node.take_notes():
            self._log("warning", note)

    def _slow_cameras(self, real_time_factor: float) -> None:
        """Does nothing: time waits for the cameras, whose rates belong to the run."""
