"""Sizes to plan a server for a team with, and a school day that shows what a number of places is worth.

The costs are measured (`docs/explanation/performance.md`): this only multiplies them, and adds up a day's
arrivals with SimPy. Nothing is run but the day.

    python -m tests.benchmarks capacity
"""

from __future__ import annotations

import math
import random
from dataclasses import dataclass
from statistics import quantiles
from typing import TYPE_CHECKING, Any, Final

import simpy

if TYPE_CHECKING:
    from collections.abc import Generator

# A session with one viewer: processor cores and memory in MB.
SESSION_CORES: Final = 0.45
SESSION_MB: Final = 300
# A core of a web server carries that many people who save, and one of PostgreSQL takes so long for a save.
EDITORS_A_CORE: Final = 280
SAVE_PERIOD_S: Final = 3.0
SAVE_MS: Final = 1.8
# Free processor time that is planned with.
SPARE: Final = 1.1

SIZES: Final = ((200, 60), (1_000, 200), (10_000, 1_500))
"""People who edit at once, and robots that run at once."""
LESSONS_H: Final = (8.0, 9.0, 10.25, 11.25, 13.0, 14.0)
LESSON_S: Final = 45 * 60.0
# People press Run within the first quarter of an hour, most of them after five minutes.
ARRIVAL_S: Final = (0.0, 900.0, 300.0)
RUN_S: Final = 20 * 60.0
SEED: Final = 1


@dataclass(frozen=True)
class Size:
    """The machines for a number of people and robots."""

    editors: int
    robots: int

    @property
    def web_cores(self) -> int:
        """Cores of web servers; at least two, so that one may fail."""
        return max(2, math.ceil(self.editors / EDITORS_A_CORE * SPARE))

    @property
    def executor_cores(self) -> int:
        """Cores of the machines on which robots run."""
        return math.ceil(self.robots * SESSION_CORES * SPARE)

    @property
    def executor_gb(self) -> int:
        """Their memory in GB."""
        return math.ceil(self.robots * SESSION_MB * SPARE / 1024)

    @property
    def saves_a_second(self) -> float:
        """Saves a second, if all people change something all the time."""
        return self.editors / SAVE_PERIOD_S

    @property
    def database_cores(self) -> int:
        """Cores of the one PostgreSQL."""
        return math.ceil(self.saves_a_second * SAVE_MS / 1000)


@dataclass(frozen=True)
class Day:
    """A school day with a number of places for robots.

    Attributes:
        waits_s: how long each person waited for a place, in s, in the order in which they got it.
        longest_queue: the largest number of people who waited at once.
        core_hours: processor time that the places held, used or not, in core hours.
    """

    waits_s: list[float]
    longest_queue: int
    core_hours: float

    @property
    def wait_95_s(self) -> float:
        """The time in s that 95 % of all people waited at most."""
        return quantiles(self.waits_s, n=20)[-1] if len(self.waits_s) > 1 else sum(self.waits_s)


def school_day(people: int, places: int, start_s: float, seed: int = SEED) -> Day:
    """Simulates the lessons of a day.

    Args:
        people: how many of a lesson want a robot.
        places: how many robots run at once.
        start_s: how long a robot takes to start, in s; with a warm pool nearly nothing.
        seed: of the arrivals and of the lengths of runs.
    """
    chance = random.Random(seed)  # noqa: S311 - a repeatable day
    world = simpy.Environment()
    robots = simpy.Resource(world, capacity=places)
    waits_s: list[float] = []
    queues = [0]

    def person(arrival_s: float, end_s: float, run_s: float) -> Generator[simpy.Event, Any, None]:
        yield world.timeout(arrival_s)
        with robots.request() as place:
            queues.append(len(robots.queue))
            given = yield place | world.timeout(max(0.0, end_s - world.now))
            if place not in given:  # the lesson is over
                waits_s.append(world.now - arrival_s)
                return
            yield world.timeout(start_s)
            waits_s.append(world.now - arrival_s)
            yield world.timeout(max(0.0, min(run_s, end_s - world.now)))

    for lesson_h in LESSONS_H:
        begin_s = lesson_h * 3600
        for _ in range(people):
            arrival_s = begin_s + chance.triangular(*ARRIVAL_S)
            world.process(person(arrival_s, begin_s + LESSON_S, chance.expovariate(1 / RUN_S)))
    world.run()
    open_h = LESSONS_H[-1] + LESSON_S / 3600 - LESSONS_H[0]
    return Day(waits_s, max(queues), places * SESSION_CORES * open_h)


def main() -> None:
    """Prints the table of sizes, and the days of a class of 200 with several numbers of places."""
    print("| people | robots | web cores | executor cores | executor GB | saves/s | PostgreSQL cores |")
    print("|---|---|---|---|---|---|---|")
    for size in (Size(*numbers) for numbers in SIZES):
        cells = (size.editors, size.robots, size.web_cores, size.executor_cores, size.executor_gb)
        row = " | ".join(f"{cell:,}" for cell in cells)
        print(f"| {row} | {size.saves_a_second:,.0f} | {size.database_cores} |")
    print("\n| places | start s | wait p95 s | longest queue | core hours a day | cores an hour |")
    print("|---|---|---|---|---|---|")
    for places in (40, 60, 80, 120):
        for start_s in (1.0, 20.0):
            day = school_day(120, places, start_s)
            hourly = places * SESSION_CORES
            print(
                f"| {places} | {start_s:.0f} | {day.wait_95_s:.0f} | {day.longest_queue} "
                f"| {day.core_hours:.0f} | {hourly:.0f} |"
            )
