"""Runs a world: physics, sensors, ROS and streams. Real time is an argument."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, Protocol

from executor.child_messages import Log, Sim
from executor.world.simulation.adaptation import CameraRates
from executor.world.simulation.pacing import Pacer
from executor.world.simulation.streams import Streams

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from executor.child_messages import Frame
    from executor.messages import LogLevel
    from executor.ros.node import WorldNode
    from executor.world.interface import World
    from executor.world.sensing.sensors import Sensors

    Send = Callable[[Sim | Log | Frame], None]


class Part(Protocol):
    """Something that works beside the world, on its time."""

    def poll(self, *, is_paused: bool = False) -> None:
        """Is called after each period of the world, and now and then while it is paused."""

    def restart(self) -> None:
        """Is called when simulated time starts again."""


PERIOD_STEPS: Final = 4  # steps between polls of the world's topics: 60 Hz
IDLE_CLOCK_S: Final = 0.05
AWAITING_S: Final = 0.005  # between two looks whether an awaited publisher is there
DRIVEN_S: Final = 0.6  # a paused world runs this long after a command by hand, to come to rest
REPORT_S: Final = 1.0
SLOW_CAMERAS: Final = (
    "This machine is too slow to draw the cameras at their rates in real time; they draw less often now."
)


@dataclass
class _Report:
    real_s: float
    simulated_s: float
    running_s: float = 0.0


class SimulationLoop:
    """Steps a world at its pace, and publishes the messages and frames that are due. It starts paused."""

    def __init__(
        self, world: World, sensors: Sensors, node: WorldNode, send: Send, *, speed: float = 1.0
    ) -> None:
        self._world = world
        self._sensors = sensors
        self._node = node
        self._send = send
        self._pacer = Pacer(world.step_s, speed)
        self._steps = 0
        self._clock_s = 0.0
        self._report: _Report | None = None
        self._camera_rates = CameraRates()
        self._last_s: float | None = None
        self._is_driven = False
        self._driven_until_s = -1.0
        self.is_paused = True
        self._clocks = 0
        self.moved: Callable[[int], None] = lambda clocks: None
        """Called after each part of the work, with the number of published times."""
        self.watchers: list[Callable[[float], None]] = []
        self.parts: list[Part] = []
        self.streams = Streams(world, sensors, send)

    def pause(self) -> None:
        """Pauses simulated time."""
        self.is_paused = True
        self._is_driven, self._driven_until_s = False, -1.0
        self._pacer.pause()

    def resume(self) -> None:
        """Resumes simulated time."""
        self.is_paused = False

    def set_speed(self, speed: float) -> None:
        """Sets the simulated seconds for each second of real time.

        With 0 the world runs as fast as the machine can.
        """
        self._pacer.set_speed(speed)

    def step(self, dt_s: float) -> None:
        """Simulates a duration immediately; for a paused world."""
        self._advance(max(1, round(dt_s / self._world.step_s)))

    def reset(self) -> None:
        """Resets the world; a paused world stays paused."""
        self._world.reset()
        self._sensors.load_scene()
        self._node.restart()
        for part in self.parts:
            part.restart()
        self.streams.scene_changed()
        self._pacer.pause()
        self._steps, self._report = 0, None

    def dump(self) -> bytes:
        """Returns the state of the world, for `load` in another process."""
        return self._world.dump()

    def load(self, data: bytes) -> None:
        """Restores a state of this world; the loop stays as it is, paused or not.

        Raises:
            WorldError: the data are not such a state.
        """
        self._world.load(data)
        self._sensors.changed()
        self._node.restart()
        for part in self.parts:
            part.restart()
        self._pacer.pause()
        self._report = None

    def teleop(self, linear: float, angular: float, *, goes_on: bool = False) -> None:
        """Drives the first robot by hand.

        With `goes_on` a paused world runs for a moment so that the robot moves.
        """
        if self._world.robots:
            self._world.robots[0].command(linear, angular)
            self._is_driven = goes_on

    def stop_robots(self) -> None:
        """Sets the target velocity of all robots to zero; pending commands are discarded."""
        self._node.poll()
        for robot in self._world.robots:
            robot.stop()

    def move_body(self, body: str, pose: Sequence[float]) -> None:
        self._world.move_body(body, pose)
        self._sensors.changed()

    def run_due(self, now_s: float) -> None:
        """Runs everything that is due at this real time."""
        stands_still = self._stands_still(now_s) or self._node.awaits_publisher(now_s)
        if stands_still:
            self._pacer.pause()
            self._idle(now_s)
        else:
            self._advance(self._pacer.due(now_s))
        self.streams.send_due(now_s)
        for watch in self.watchers:
            watch(now_s)
        self._report_due(now_s, is_running=not stands_still)

    def next_due_s(self, now_s: float) -> float:
        """Returns the seconds until `run_due` has something to do."""
        if self._node.awaits_publisher(now_s):
            return AWAITING_S
        if not self.is_paused or self._is_driven or now_s < self._driven_until_s:
            return self._pacer.next_due_s(now_s, PERIOD_STEPS - self._steps % PERIOD_STEPS)
        idle = self._clock_s + IDLE_CLOCK_S - now_s
        return max(0.0, min(idle, self.streams.next_due_s(now_s) or IDLE_CLOCK_S))

    def _stands_still(self, now_s: float) -> bool:
        if self._is_driven:
            self._is_driven, self._driven_until_s = False, now_s + DRIVEN_S
        return self.is_paused and now_s >= self._driven_until_s

    def _idle(self, now_s: float) -> None:
        """Publishes the simulated time also while it is paused, for nodes that join during the pause."""
        if now_s - self._clock_s >= IDLE_CLOCK_S:
            self._clock_s = now_s
            self._node.poll()
            for part in self.parts:
                part.poll(is_paused=True)
            self._node.publish_clock()
            self._told_time()

    def _advance(self, steps: int) -> None:
        while steps > 0:
            count = min(steps, PERIOD_STEPS - self._steps % PERIOD_STEPS)
            self._world.step(count)
            self._steps += count
            steps -= count
            self._sensors.changed()
            if self._steps % PERIOD_STEPS == 0:
                self._node.poll()
                for part in self.parts:
                    part.poll()
                self._node.publish(self._sensors)
                self._told_time()
        self._tell_collisions()
        for note in self._node.take_notes():
            self._log("warning", note)

    def _told_time(self) -> None:
        self._clocks += 1
        self.moved(self._clocks)

    def _tell_collisions(self) -> None:
        for robot, collision in self._world.take_collisions():
            self._log("warning", collision.told(robot), collision.time_s)

    def _report_due(self, now_s: float, *, is_running: bool) -> None:
        report = self._report
        if report is None:
            report = self._report = _Report(now_s, self._world.time_s)
        if is_running and self._last_s is not None:
            report.running_s += now_s - self._last_s
        self._last_s = now_s
        if now_s - report.real_s < REPORT_S:
            return
        simulated = self._world.time_s - report.simulated_s
        factor = simulated / report.running_s if report.running_s > 0 else 0.0
        if report.running_s > REPORT_S / 2:
            self._slow_cameras(factor)
        self._report = _Report(now_s, self._world.time_s)
        robot = self._world.robots[0] if self._world.robots else None
        self._send(
            Sim(
                t=self._world.time_s,
                real_time_factor=factor,
                speed=self._pacer.speed,
                paused=self.is_paused,
                camera_share=self.streams.camera_share,
                tick_ms=0.0,
                tick_budget_ms=0.0,
                collisions=robot.collisions if robot else 0,
                hits=robot.hits if robot else 0,
                distance_m=robot.distance_m if robot else 0.0,
                pose=robot.pose if robot else (0.0, 0.0, 0.0),
            )
        )

    def _slow_cameras(self, real_time_factor: float) -> None:
        """Reduces the rates of cameras if the machine is too slow for real time."""
        old = self._camera_rates.share
        in_use = self._node.wants_pictures() or self.streams.has_camera
        self._camera_rates.note(real_time_factor if in_use else self._pacer.speed, self._pacer.speed)
        share = self._camera_rates.share
        if share == old:
            return
        self._node.slow_cameras(share)
        self.streams.camera_share = share
        if old == 1.0:
            self._log("warning", SLOW_CAMERAS)
        elif share == 1.0:
            self._log("info", "The cameras are at their full rates again.")

    def _log(self, level: LogLevel, text: str, time_s: float | None = None) -> None:
        at = self._world.time_s if time_s is None else time_s
        self._send(Log(level, text, time=at))
