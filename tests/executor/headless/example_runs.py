"""Drives the examples in lock-step over seeds and says how often each does what it teaches.

`python -m tests.executor.headless.example_runs 20 push_box follow_line` prints the rows of the table in
`docs/how-to/examples.md`; without names it drives all. It ends with 1 if a run fails. All runs share one
process: ROS reads its environment once, and loading costs more than most runs.
"""

from __future__ import annotations

import contextlib
import math
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from executor.headless.lockstep import LockstepOptions, run_lockstep

if TYPE_CHECKING:
    from collections.abc import Callable

    from executor.headless.report import Report

EXAMPLES: Final = Path(__file__).parents[3] / "examples"
Place = tuple[float, float]


@dataclass
class Drive:
    """The places of a run in m, in the frame of the world, before each tick."""

    report: Report
    robots: dict[str, list[Place]] = field(default_factory=dict)
    bodies: dict[str, Place] = field(default_factory=dict)
    people: list[float] = field(default_factory=list)
    models: tuple[Any, ...] = ()

    @property
    def way(self) -> list[Place]:
        """The places of the first robot."""
        return next(iter(self.robots.values()))

    def ticks_of(self, type_: str, status: str) -> int:
        """Returns how often the nodes of a type had a status."""
        nodes: list[Any] = self.report.nodes
        return sum(getattr(n, status) for n in nodes if n.path.rsplit("/")[-1].startswith(type_))

    def comes_near(self, place: Place, distance_m: float) -> bool:
        """Whether the first robot was within a distance of a place."""
        return any(math.dist(at, place) <= distance_m for at in self.way)

    def touched_nothing(self) -> bool:
        """Whether nothing failed and the robot met nothing."""
        return not self.report.errors and self.report.collisions == 0


@dataclass(frozen=True)
class Example:
    """An example, for how many simulated seconds it drives, and what counts as success."""

    name: str
    duration_s: float
    wanted: str
    has_succeeded: Callable[[Drive], bool]


def _bumps_and_goes(drive: Drive) -> bool:
    return drive.touched_nothing() and drive.report.distance_m > 5


def _follows_the_wall(drive: Drive) -> bool:
    walls = [_box(m) for m in drive.models if m.shape == "box" and m.size[2] > 1]
    gaps = [min(_gap(at, wall) for wall in walls) for at in drive.way[200:]]
    near = sum(0.25 < gap < 0.8 for gap in gaps)
    return drive.touched_nothing() and drive.report.distance_m > 12 and near > 0.9 * len(gaps)


def _stays_on_the_line(drive: Drive) -> bool:
    line = [_box(m) for m in drive.models if m.id.startswith("line_")]
    off = max(min(_gap(at, piece) for piece in line) for at in drive.way)
    return drive.touched_nothing() and drive.report.distance_m > 6 and off < 0.3


def _patrols_and_charges(drive: Drive) -> bool:
    posts = ((2, 1.5), (2, -1.2), (-2, -1.2), (-2, 1.5))
    charged = drive.ticks_of("Charge", "running") > 40 and drive.comes_near((0, -2), 0.3)
    visited = all(drive.comes_near(post, 0.3) for post in posts)
    return drive.touched_nothing() and drive.report.root_status == "RUNNING" and charged and visited


def _stops_at_the_pillar(drive: Drive) -> bool:
    left = math.dist(drive.way[-1], drive.bodies["red"])
    return drive.touched_nothing() and drive.report.root_status == "SUCCESS" and 0.4 < left < 0.95


def _brings_the_box(drive: Drive) -> bool:
    off = math.dist(drive.bodies["box"], (2.5, 0))
    return not drive.report.errors and drive.report.root_status == "SUCCESS" and off < 0.3


def _follows_the_person(drive: Drive) -> bool:
    near = sum(distance < 4 for distance in drive.people)
    return drive.touched_nothing() and near > 0.9 * len(drive.people)


def _crosses_untouched(drive: Drive) -> bool:
    return drive.touched_nothing() and drive.report.root_status == "SUCCESS"


def _hands_over(drive: Drive) -> bool:
    off = math.dist(drive.bodies["parcel"], (1.8, 1.0))
    return not drive.report.errors and drive.report.root_status == "SUCCESS" and off < 0.4


def _finds_the_way(drive: Drive) -> bool:
    left = math.dist(drive.way[-1], (1.95, 1.95))
    return drive.touched_nothing() and drive.report.root_status == "SUCCESS" and left < 0.9


RUNS: Final = (
    Example("laser_bump_and_go", 60, "drives 5 m in a minute and touches nothing", _bumps_and_goes),
    Example(
        "follow_wall", 60, "drives 12 m in a minute, nine tenths of it beside a wall, and touches none",
        _follows_the_wall,
    ),
    Example("follow_line", 30, "drives 6 m in 30 s and is never 30 cm off the line", _stays_on_the_line),
    Example(
        "patrol_battery", 100, "visits all posts in 100 s, charges, and is never empty",
        _patrols_and_charges,
    ),
    Example("search_color", 60, "stops before the red pillar within a minute", _stops_at_the_pillar),
    Example("push_box", 150, "brings the box within 30 cm of the goal's middle", _brings_the_box),
    Example(
        "visual_follow_person", 30, "stays near the person for 30 s and touches nobody", _follows_the_person
    ),
    Example("cross_crowd", 90, "reaches the other side in 90 s and touches nobody", _crosses_untouched),
    Example("hand_over", 60, "two robots bring the parcel within 40 cm of the goal's middle", _hands_over),
    Example("explore_maze", 150, "reaches the goal of the maze and touches no wall", _finds_the_way),
)  # fmt: skip


def _box(model: Any) -> tuple[float, float, float, float, float]:
    return (*model.pose[:2], model.pose[5], model.size[0] / 2, model.size[1] / 2)


def _gap(place: Place, box: tuple[float, float, float, float, float]) -> float:
    """Returns the distance from a place to a box on the floor; 0 inside of it."""
    x, y, yaw, half_x, half_y = box
    dx, dy = place[0] - x, place[1] - y
    along = abs(dx * math.cos(yaw) + dy * math.sin(yaw)) - half_x
    across = abs(dy * math.cos(yaw) - dx * math.sin(yaw)) - half_y
    return math.hypot(max(0.0, along), max(0.0, across))


def drive(example: Example, seed: int) -> Drive:
    """Drives an example once."""
    seen = Drive(report=None)

    def watch(world: Any, _tree: Any) -> None:
        for robot in world.robots:
            seen.robots.setdefault(robot.id, []).append(robot.pose[:2])
        people = [math.dist(actor.position[:2], seen.way[-1]) for actor in world.actors]
        seen.people += [min(people)] if people else []
        seen.models = world.universe.models
        for each, pose in zip(world.scene.objects, world.poses(), strict=True):
            seen.bodies[each.body] = (float(pose[0]), float(pose[1]))

    options = LockstepOptions(duration_s=example.duration_s, seed=seed)
    with contextlib.redirect_stdout(sys.stderr):
        seen.report = run_lockstep(EXAMPLES / example.name, options, watch=watch)
    return seen


def main(arguments: list[str] | None = None) -> int:
    """Drives the named examples, or all, and prints a row for each; 1 if a run fails."""
    seeds, *names = sys.argv[1:] if arguments is None else arguments
    has_failed = _drive_all(int(seeds), names)
    return int(has_failed)


def _drive_all(seeds: int, names: list[str]) -> bool:
    has_failed = False
    for example in RUNS:
        if names and example.name not in names:
            continue
        failed = [seed for seed in range(seeds) if not example.has_succeeded(drive(example, seed))]
        has_failed = has_failed or bool(failed)
        share = f"{seeds - len(failed)} of {seeds}"
        print(f"| `{example.name}` | {example.wanted} | {share} |", flush=True)  # noqa: T201 - the result
        if failed:
            print(f"{example.name} failed with the seeds {failed}", file=sys.stderr)  # noqa: T201
    return has_failed


if __name__ == "__main__":
    sys.exit(main())
