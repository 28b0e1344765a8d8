"""Where the wheels slip nothing, odometry is the truth: 2 m, and a whole turn on the spot."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import TYPE_CHECKING

import pytest

from executor.robots import load_robot, robot_ids

if TYPE_CHECKING:
    from executor.robots.config import RobotConfig
    from tests.executor.world.conftest import MakeWorld

WITHIN = 0.005
AT_MOST_S = 60
TICK_STEPS = 12
PART = 0.5
"""Of the largest speed: how far a rover skids depends on it."""


def without_slip(model: str, *, cylinders: bool) -> RobotConfig:
    """Returns a robot of the catalogue whose odometry has no noise; its spheres may be cylinders."""
    config = load_robot(model)
    radius, text = config.drive.wheel_radius, config.urdf.text
    if cylinders:
        sphere = rf'<origin [^/]*/><geometry><sphere radius="{re.escape(str(radius))}"/></geometry>'
        wheel = (
            '<origin xyz="0 0 0" rpy="1.5707963 0 0"/>'
            f'<geometry><cylinder radius="{radius}" length="0.02"/></geometry>'
        )
        text, count = re.subn(sphere, wheel, text)
        assert count == len(config.drive.left) + len(config.drive.right)
    drive = config.drive.model_copy(update={"slip_noise": 0.0})
    return replace(config, drive=drive, urdf=replace(config.urdf, text=text))


@pytest.mark.parametrize("cylinders", [False, True], ids=["wheels as they are", "wheels of cylinders"])
@pytest.mark.parametrize("model", robot_ids())
@pytest.mark.parametrize("move", [(PART, 0.0, 2.0), (0.0, PART, 2 * math.pi)], ids=["2 m", "one turn"])
def test_the_true_pose_is_that_of_the_odometry(
    make_world: MakeWorld, model: str, move: tuple[float, float, float], cylinders: bool
) -> None:
    linear, angular, wanted = move
    config = without_slip(model, cylinders=cylinders)
    world = make_world(f"robots: [{{id: robot, model: {model}}}]\n", configs=[config])
    robot = world.robots[0]
    world.step(240)
    start, begin = robot.pose, robot.odometry
    turned = believed = 0.0
    for _ in range(AT_MOST_S * 20):
        way = math.dist((robot.odometry.x, robot.odometry.y), (begin.x, begin.y))
        if max(way, believed) >= wanted:
            break
        before = robot.pose[2], robot.odometry.yaw
        robot.command(linear * config.drive.max_linear, angular * config.drive.max_angular)
        world.step(TICK_STEPS)
        turned += math.remainder(robot.pose[2] - before[0], 2 * math.pi)
        believed += math.remainder(robot.odometry.yaw - before[1], 2 * math.pi)
    if angular:
        assert believed >= wanted
        assert turned == pytest.approx(believed, rel=WITHIN)
    else:
        assert way >= wanted
        assert math.dist(robot.pose[:2], start[:2]) == pytest.approx(way, rel=WITHIN)
