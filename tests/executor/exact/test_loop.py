"""The loop of an exact run: real time decides when, never what."""

from __future__ import annotations

import random
from typing import Any

import pytest

from executor.exact.loop import ExactLoop
from executor.headless.stepper import Stepper
from tests.budget import count
from tests.fakes.stepped_world import STEP_S, SteppedNode, SteppedWorld, stepped_sensors


class Bench:
    """A loop, whose ticks are written into the log of its world."""

    def __init__(self, tick_hz: float = 20.0) -> None:
        self.world = SteppedWorld()
        node: Any = SteppedNode(self.world)
        world: Any = self.world
        self.is_ticking = True
        self.sent: list[Any] = []
        self.slept: list[float] = []
        self.loop = ExactLoop(
            world,
            stepped_sensors(),
            node,
            self.sent.append,
            stepper=Stepper(world, stepped_sensors(), node),
            tick=lambda: self.world.log.append(("tick", self.world.steps)),
            is_ticking=lambda: self.is_ticking,
            tick_hz=tick_hz,
            sleep=self.slept.append,
        )
        self.now = 100.0

    def run(self, duration_s: float, every_s: float = 0.01) -> None:
        """Calls the loop as real time passes."""
        for _ in range(round(duration_s / every_s)):
            self.now += every_s
            self.loop.run_due(self.now)

    @property
    def ticks(self) -> list[int]:
        return [step for what, step in self.world.log if what == "tick"]


def test_ticks_come_at_their_steps_and_commands_are_read_after_them() -> None:
    bench = Bench()
    bench.loop.resume()
    bench.run(0.5)
    assert bench.ticks == list(range(0, bench.world.steps + 1, 12))
    polls = [step for what, step in bench.world.log if what == "poll"]
    assert polls == bench.ticks


@pytest.mark.parametrize("tick_hz", [20.0, 7.0, 50.0, 240.0, 1000.0])
def test_speeds_pauses_and_steps_change_nothing(tick_hz: float) -> None:
    """Random handling, against a loop that runs as fast as it can."""
    straight = Bench(tick_hz)
    straight.loop.set_speed(0)
    straight.loop.resume()
    straight.run(8.0)
    assert straight.world.steps > 38000  # more than any of the others
    for seed in range(count("exact_loops")):
        chance, bench = random.Random(seed), Bench(tick_hz)  # noqa: S311 - a test
        for _ in range(60):
            match chance.randrange(4):
                case 0:
                    bench.loop.set_speed(chance.choice([0.1, 0.5, 1.0, 3.0, 10.0]))
                case 1:
                    bench.loop.pause()
                    bench.run(chance.uniform(0, 0.2))
                    for _ in range(chance.randrange(3)):
                        bench.loop.tick()
                        bench.loop.step(1 / tick_hz)
                case 2:
                    bench.is_ticking = chance.random() < 0.8
            bench.loop.resume()
            bench.run(chance.uniform(0, 0.2), chance.choice([0.001, 0.004, 0.03]))
        assert bench.world.log == straight.world.log[: len(bench.world.log)]
        assert bench.world.steps > 100


def test_a_loop_whose_tree_does_not_tick_waits_before_the_tick() -> None:
    bench = Bench()
    bench.loop.resume()
    bench.run(0.12)
    bench.is_ticking = False
    bench.run(1.0)
    assert bench.world.steps == bench.loop.next_tick_step
    assert bench.ticks[-1] == bench.world.steps - 12
    assert bench.loop.next_due_s(bench.now) > 0
    bench.is_ticking = True
    bench.run(0.02)
    assert bench.ticks[-1] >= bench.world.steps - 12


def test_a_paused_loop_does_nothing() -> None:
    bench = Bench()
    bench.run(1.0)
    assert bench.world.log == []


def test_the_speed_is_that_of_real_time() -> None:
    bench = Bench()
    bench.loop.resume()
    bench.run(2.0, 0.005)
    assert abs(bench.world.time_s - 2.0) < 0.05
    bench.loop.set_speed(5.0)
    bench.run(2.0, 0.005)
    assert abs(bench.world.time_s - 12.0) < 0.2


def test_a_slow_tick_is_not_caught_up() -> None:
    bench = Bench()
    bench.loop.resume()
    bench.run(0.5)
    before = bench.world.steps
    bench.now += 30.0
    bench.loop.run_due(bench.now)
    assert (bench.world.steps - before) * STEP_S <= 0.2


def test_another_rate_counts_from_the_last_tick() -> None:
    bench = Bench()
    bench.loop.tick()
    bench.loop.tick()
    bench.loop.set_tick_rate(10.0)
    bench.loop.tick()
    bench.loop.tick()
    assert bench.ticks == [0, 12, 36, 60]


def test_a_reset_begins_again() -> None:
    bench = Bench()
    for _ in range(3):
        bench.loop.tick()
    bench.loop.reset()
    bench.world.log.clear()
    bench.loop.tick()
    bench.loop.tick()
    assert bench.ticks == [0, 12]


def test_time_passes_at_its_pace_while_an_action_waits() -> None:
    bench = Bench()
    bench.loop.set_speed(2.0)
    bench.loop.let_time_pass()
    assert bench.world.steps == 4
    assert bench.slept == [pytest.approx(4 * STEP_S / 2.0)]
    bench.loop.set_speed(0)
    bench.loop.let_time_pass()
    assert len(bench.slept) == 1
    bench.loop.tick()
    assert bench.ticks == [8]  # it was due before


def test_it_makes_one_tick_and_stops_at_each_part_of_the_way() -> None:
    bench = Bench()
    places: list[tuple[int, int]] = []
    for _ in range(3):
        bench.loop.run_to_tick(lambda: places.append((bench.loop.ticks, bench.loop.step_number)))
    assert bench.ticks == [0, 12, 24]
    assert places == [(0, 0), (1, 0), (1, 4), (1, 8), (1, 12), (2, 12), (2, 16), (2, 20), (2, 24)]
    bench.loop.run_to_step(30)
    assert (bench.loop.step_number, bench.loop.time_s) == (32, 32 * STEP_S)
    bench.loop.run_to_step(1000)
    assert (bench.world.steps, bench.ticks) == (36, [0, 12, 24])  # the tick is not made
    bench.loop.reset()
    assert bench.loop.ticks == 3  # all ticks count
    bench.loop.set_speed(3.0)
    assert (bench.loop.speed, bench.loop.tick_hz) == (3.0, 20.0)
