"""An inertial measurement unit."""

from __future__ import annotations

import math

import pytest

from executor.robots.sensors import Imu
from executor.world.sensing.imu import GRAVITY, ImuModel

AT_REST = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def model(**noise: float) -> ImuModel:
    return ImuModel(Imu(kind="imu", link="base", **noise), (1,))


def test_at_rest_it_feels_gravity_upwards() -> None:
    imu = model()
    imu.observe((0, 0, 0), 0.1)
    imu.observe((0, 0, 0), 0.1)
    assert imu.reading(0.0, AT_REST, (0, 0, 0)).acceleration == pytest.approx((0, 0, GRAVITY))
    assert not imu.has_drawn


def test_speeding_up_is_felt_in_its_own_frame() -> None:
    imu = model()
    for speed in (0.0, 0.5):
        imu.observe((speed, 0, 0), 0.1)
    half = math.sqrt(0.5)
    reading = imu.reading(0.0, (0, 0, 0, 0, 0, half, half), (0, 0, 1))
    assert reading.acceleration == pytest.approx((0, -5, GRAVITY), abs=1e-6)
    assert reading.rate == pytest.approx((0, 0, 1))


def test_noise_is_that_of_the_time() -> None:
    imu = model(rate_noise=0.1)
    readings = [imu.reading(time_s, AT_REST, (0, 0, 0)).rate for time_s in (1.0, 1.0, 2.0)]
    assert readings[0] == readings[1] != readings[2]
    assert imu.has_drawn
