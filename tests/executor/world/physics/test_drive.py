import math

import pytest

from executor.robots import load_robot
from executor.world.physics.drive import DifferentialDrive

CONFIG = load_robot("turtle2").drive
DT = 1 / 60


def rates_after(drive: DifferentialDrive, seconds: float, start_s: float = 0.0) -> tuple[float, float]:
    rates = (0.0, 0.0)
    for i in range(round(seconds / DT)):
        rates = drive.wheel_rates(start_s + i * DT, DT)
    return rates


def test_straight_ahead_turns_both_wheels_alike() -> None:
    drive = DifferentialDrive(CONFIG)
    assert drive.command(0.3, 0.0, 0.0)
    assert rates_after(drive, 0.5) == pytest.approx((0.3 / CONFIG.wheel_radius,) * 2)


def test_turning_left_turns_the_right_wheel_ahead() -> None:
    drive = DifferentialDrive(CONFIG)
    drive.command(0.0, 1.0, 0.0)
    left, right = rates_after(drive, 0.5)
    assert right == pytest.approx(CONFIG.track / 2 / CONFIG.wheel_radius)
    assert left == pytest.approx(-right)


def test_speed_and_acceleration_are_limited() -> None:
    drive = DifferentialDrive(CONFIG)
    drive.command(50.0, 0.0, 0.0)
    first = drive.wheel_rates(0.0, DT)[0] * CONFIG.wheel_radius
    assert first == pytest.approx(CONFIG.linear_acceleration * DT)
    drive.command(50.0, 0.0, 0.5)
    assert rates_after(drive, 1.0, 0.1)[0] * CONFIG.wheel_radius == pytest.approx(CONFIG.max_linear)


def test_the_robot_stops_when_commands_stop() -> None:
    drive = DifferentialDrive(CONFIG)
    drive.command(0.3, 0.2, 0.0)
    assert rates_after(drive, CONFIG.timeout_s)[0] > 0
    assert rates_after(drive, 1.0, CONFIG.timeout_s + 0.01) == (0.0, 0.0)


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_command_that_is_no_number_is_refused(value: float) -> None:
    drive = DifferentialDrive(CONFIG)
    assert not drive.command(value, 0.0, 0.0)
    assert not drive.command(0.0, value, 0.0)
    assert rates_after(drive, 0.2) == (0.0, 0.0)


def test_odometry_follows_a_circle_exactly() -> None:
    drive = DifferentialDrive(CONFIG)
    drive.observe(0.0, 0.0, DT)
    radius, turned = 0.5, math.pi / 2
    steps = 90
    for i in range(1, steps + 1):
        angle = turned * i / steps
        left = angle * (radius - CONFIG.track / 2) / CONFIG.wheel_radius
        right = angle * (radius + CONFIG.track / 2) / CONFIG.wheel_radius
        odometry = drive.observe(left, right, DT)
    assert (odometry.x, odometry.y, odometry.yaw) == pytest.approx((radius, radius, turned))
    assert odometry.angular == pytest.approx(turned / steps / DT)
    assert odometry.linear == pytest.approx(radius * turned / steps / DT)
