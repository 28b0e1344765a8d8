"""The controller: limits at every pose, and arrival on random paths."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from executor.navigation.pursuit import Limits, command, nearest, point_ahead, remaining, turn_to, wrapped

LIMITS = Limits()
STRAIGHT = [(0.1 * i, 0.0) for i in range(41)]


@given(
    st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5)), min_size=1, max_size=20),
    st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-4, 4)),
    st.floats(-1, 1),
    st.floats(-0.2, 3),
)
def test_the_command_is_within_the_limits(path, pose, speed, clearance) -> None:
    linear, angular = command(path, pose, speed, clearance, index=nearest(path, pose))
    assert 0 <= linear <= LIMITS.speed
    assert abs(angular) <= LIMITS.turn + 1e-9


@settings(max_examples=40, deadline=None)
@given(st.floats(-1.2, 1.2), st.floats(-math.pi, math.pi), st.floats(0.5, 2.0))
def test_a_robot_follows_a_winding_path_to_its_end(amplitude: float, yaw: float, wave: float) -> None:
    path = [(0.05 * i, amplitude * math.sin(0.05 * i * wave)) for i in range(100)]
    x, y, speed, index = 0.0, 0.0, 0.0, 0
    for _ in range(2000):
        index = nearest(path[: index + 20], (x, y, yaw), index)
        if math.dist((x, y), path[-1]) < 0.15:
            break
        speed, turn = command(path, (x, y, yaw), speed, 1.0, index=index)
        yaw += turn * 0.05
        x, y = x + speed * 0.05 * math.cos(yaw), y + speed * 0.05 * math.sin(yaw)
        assert min(math.dist((x, y), point) for point in path) < 0.45
    assert math.dist((x, y), path[-1]) < 0.15


def test_it_turns_on_the_spot_towards_a_path_behind() -> None:
    linear, angular = command(STRAIGHT, (0.0, 0.0, math.pi - 0.1), 0.0, 1.0)
    assert linear == 0
    assert angular < 0


def test_it_is_slower_near_obstacles_and_near_the_end() -> None:
    free = command(STRAIGHT, (0.0, 0.0, 0.0), 0.4, 1.0)[0]
    assert free == LIMITS.speed
    assert command(STRAIGHT, (0.0, 0.0, 0.0), 0.4, 0.1)[0] < free
    assert command(STRAIGHT, (3.8, 0.0, 0.0), 0.4, 1.0, index=38)[0] < free


def test_helpers() -> None:
    assert wrapped(3 * math.pi / 2) == pytest.approx(-math.pi / 2)
    assert remaining(STRAIGHT, 20) == pytest.approx(2.0)
    assert point_ahead(STRAIGHT, (0.0, 0.0, 0.0), 0, 0.45) == pytest.approx((0.5, 0.0))
    assert point_ahead(STRAIGHT, (0.0, 0.0, 0.0), 0, 99) == STRAIGHT[-1]
    assert turn_to(1.0, (0, 0, 0.5)) == pytest.approx(1.0)
    assert turn_to(math.pi, (0, 0, 0)) == LIMITS.turn
