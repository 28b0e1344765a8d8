import math
from typing import TYPE_CHECKING

import numpy as np
import pytest

if TYPE_CHECKING:
    from tests.executor.world.conftest import MakeWorld

HALF = 3.0
SQUARE_ROOM = f"""
models:
  - {{id: e, shape: box, size: [0.2, 8, 1], pose: [{HALF + 0.1}, 0, 0.5, 0, 0, 0]}}
  - {{id: w, shape: box, size: [0.2, 8, 1], pose: [{-HALF - 0.1}, 0, 0.5, 0, 0, 0]}}
  - {{id: n, shape: box, size: [8, 0.2, 1], pose: [0, {HALF + 0.1}, 0.5, 0, 0, 0]}}
  - {{id: s, shape: box, size: [8, 0.2, 1], pose: [0, {-HALF - 0.1}, 0.5, 0, 0, 0]}}
"""


def test_ranges_in_a_known_room_are_analytic(make_world: "MakeWorld") -> None:
    world = make_world(SQUARE_ROOM + "robots: [{id: robot, pose: [0.5, -1.0, 0, 0, 0, 0.7]}]\n")
    robot = world.robots[0]
    lidar = robot.config.lidars[0]
    reading = robot.scan(lidar)
    x, y, yaw = robot.pose
    errors = []
    for i in range(360):
        angle = yaw + math.radians(i)
        c, s = math.cos(angle), math.sin(angle)
        to_x = ((HALF if c > 0 else -HALF) - x) / c if abs(c) > 1e-9 else math.inf
        to_y = ((HALF if s > 0 else -HALF) - y) / s if abs(s) > 1e-9 else math.inf
        errors.append(reading.ranges[i] - min(to_x, to_y))
        assert errors[i] == pytest.approx(0.0, abs=5e-3 + 5 * lidar.noise_m), f"ray {i}"
    # The noise of 360 rays is 19 times less than that of one.
    assert np.mean(errors) == pytest.approx(0.0, abs=5e-3)


def test_nothing_in_range_is_plus_infinity(make_world: "MakeWorld") -> None:
    robot = make_world("empty").robots[0]
    assert np.isposinf(robot.scan(robot.config.lidars[0]).ranges).all()


def test_too_near_is_minus_infinity(make_world: "MakeWorld") -> None:
    world = make_world(
        "models:\n  - {id: post, shape: cylinder, size: [0.02, 2], pose: [0.1, 0, 1, 0, 0, 0]}\n"
    )
    ranges = world.robots[0].scan(world.robots[0].config.lidars[0]).ranges
    assert np.isneginf(ranges[0])
    assert np.isposinf(ranges[180])


def test_scans_start_straight_ahead_and_turn_left(make_world: "MakeWorld") -> None:
    world = make_world(
        "models:\n  - {id: left, shape: box, size: [0.4, 0.4, 1], pose: [0, 2, 0.5, 0, 0, 0]}\n"
    )
    ranges = world.robots[0].scan(world.robots[0].config.lidars[0]).ranges
    assert np.isfinite(ranges[90])
    assert not np.isfinite(ranges[270])
