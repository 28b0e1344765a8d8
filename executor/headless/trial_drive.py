"""A test drive of a robot on an empty floor: 1 m straight on and 360°, commanded against done."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from executor.universes.loader import parse_universe
from executor.world.physics.bullet import BulletWorld

if TYPE_CHECKING:
    from pathlib import Path

    from executor.robots.importing.bring import Made

WAY_M: Final = 1.0
TURN_RAD: Final = 2 * math.pi
WAY_TOLERANCE_M: Final = 0.05
TURN_TOLERANCE_DEG: Final = 10.0
SKID: Final = 0.05
"""Share of the friction along y for wheels that must slide sideways when the robot turns."""
_FLOOR: Final = "format: bt-studio/universe\nversion: 1\nname: floor\n"
_PERIOD: Final = 12
_SETTLE: Final = 240


@dataclass(frozen=True)
class Trial:
    """The motion of a robot at a command of 1 m and of 360°; `aside_m` is the way to the side."""

    way_m: float
    aside_m: float
    turn_deg: float

    @property
    def fits(self) -> bool:
        """Whether the robot moved as commanded, within 5 cm and 10°."""
        is_straight = abs(self.way_m - WAY_M) <= WAY_TOLERANCE_M and abs(self.aside_m) <= WAY_TOLERANCE_M
        return is_straight and self.turns

    @property
    def turns(self) -> bool:
        """Whether the robot turned by 360°, within 10°."""
        return abs(self.turn_deg - 360.0) <= TURN_TOLERANCE_DEG

    def __str__(self) -> str:
        return f"1.00 m commanded, {self.way_m:.2f} m driven; 360° commanded, {self.turn_deg:.0f}° turned"


def drive_once(robot: str, assets: Path) -> Trial:
    """Drives a robot of a project; returns what it did."""
    world = BulletWorld(parse_universe(_FLOOR), robot=robot, assets=assets)
    try:
        body = world.robots[0]
        world.step(_SETTLE)
        limits = body.config.drive
        speed = min(0.25, limits.max_linear)
        x, y, yaw = body.pose
        _play(world, speed, 0.0, _duration(WAY_M, speed, limits.linear_acceleration))
        ahead = body.pose
        forward, left = ahead[0] - x, ahead[1] - y
        way = forward * math.cos(yaw) + left * math.sin(yaw)
        aside = left * math.cos(yaw) - forward * math.sin(yaw)
        rate = min(1.0, limits.max_angular)
        turned = _play(world, 0.0, rate, _duration(TURN_RAD, rate, limits.angular_acceleration))
        return Trial(way, aside, math.degrees(turned))
    finally:
        world.close()


def fit(made: Made, robot: str, source: str, project: Path) -> Trial:
    """Writes a robot into a project and drives it; sets `skid` and `turn_factor` of one that turns wrong.

    Returns the last drive; the report of the robot says what was set.
    """
    document, base = made.document, made.base

    def drive() -> Trial:
        write_robot(made.written(source), project / "robots" / robot)
        return drive_once(robot, project)

    trial = drive()
    wheels = [link for link in document["wheels"] if link not in base.castors]
    if not trial.turns and len(wheels) > 2:
        document["skid"] = dict.fromkeys(wheels, SKID)
        made.report.assumed.append(
            f"it turned by {trial.turn_deg:.0f}°: its wheels slide sideways (skid: {SKID})"
        )
        trial = drive()
    if not trial.turns and len(wheels) > 2 and 60.0 < trial.turn_deg < 1080.0:
        factor = round(360.0 / trial.turn_deg, 3)
        settings: dict[str, Any] = document["drive"]
        settings["turn_factor"] = factor
        made.report.assumed.append(f"it turned by {trial.turn_deg:.0f}°: its turn_factor is {factor:g}")
        trial = drive()
    return trial


def write_robot(files: dict[str, bytes], folder: Path) -> None:
    """Writes the files of a robot into its folder."""
    for name, data in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def _duration(way: float, speed: float, acceleration: float) -> float:
    """Returns how long to command a speed so that the way with both ramps is `way`."""
    return max(way / speed, speed / acceleration)


def _play(world: BulletWorld, linear: float, angular: float, seconds: float) -> float:
    """Commands a twist, then a stop; returns the angle in rad by which the robot turned."""
    body = world.robots[0]
    turned, last = 0.0, body.pose[2]
    periods = round(seconds / (_PERIOD * world.step_s))
    for number in range(periods + 30):
        if number < periods:
            body.command(linear, angular)
        else:
            body.stop()
        world.step(_PERIOD)
        now = body.pose[2]
        turned += math.remainder(now - last, 2 * math.pi)
        last = now
    return turned
