"""The recoveries: how far they go, and how they end."""

from __future__ import annotations

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from executor.navigation.motions import Drive, Motion, Spin, Step, Wait

Pose = tuple[float, float, float]


def play(motion: Motion, pose: Pose = (0.0, 0.0, 0.0), dt_s: float = 0.02) -> tuple[Step, Pose, float]:
    """Moves an ideal robot until the motion is over; returns its last step, the pose and the time."""
    x, y, yaw = pose
    for tick in range(10_000):
        step = motion.step(tick * dt_s, (x, y, yaw))
        if step.is_over:
            return step, (x, y, yaw), tick * dt_s
        yaw = math.remainder(yaw + step.angular * dt_s, math.tau)
        x, y = x + step.linear * dt_s * math.cos(yaw), y + step.linear * dt_s * math.sin(yaw)
    raise AssertionError("the motion never ends")


@settings(deadline=None)
@given(st.floats(-10, 10), st.floats(-3, 3))
def test_a_spin_turns_by_its_angle_also_beyond_a_full_turn(angle: float, yaw: float) -> None:
    step, pose, _ = play(Spin(angle, 0, 0, (0, 0, yaw)), (0, 0, yaw))
    assert step.error == ""
    assert step.covered == pytest.approx(abs(angle), abs=0.05)
    assert math.cos(pose[2] - yaw - angle) > 0.998


def test_a_spin_that_takes_too_long_ends() -> None:
    step, _, time_s = play(Spin(20, 1.0, 0, (0, 0, 0)))
    assert (step.error, time_s) == ("timeout", 1.0)


@settings(deadline=None)
@given(st.floats(0.05, 2), st.sampled_from([-0.2, 0.3]), st.floats(-3, 3))
def test_a_drive_covers_its_distance(distance: float, speed: float, yaw: float) -> None:
    start = (0.0, 0.0, yaw)
    step, pose, _ = play(Drive(distance, speed, 0, 0, pose=start, allows=lambda x, y: True), start)
    assert step.error == ""
    along = pose[0] * math.cos(yaw) + pose[1] * math.sin(yaw)
    assert along == pytest.approx(math.copysign(distance, speed), abs=0.02)


def test_a_drive_stops_before_an_obstacle_but_leaves_one() -> None:
    step, pose, _ = play(Drive(2, 0.2, 0, 0, pose=(0, 0, 0), allows=lambda x, y: x < 1))
    assert step.error == "collision"
    assert 0.7 < pose[0] < 1
    step, pose, _ = play(Drive(0.5, -0.2, 0, 0, pose=(0, 0, 0), allows=lambda x, y: x < -0.2))
    assert step.error == ""


def test_a_drive_that_takes_too_long_ends() -> None:
    step, _, time_s = play(Drive(5, 0.1, 2.0, 0, pose=(0, 0, 0), allows=lambda x, y: True))
    assert (step.error, time_s) == ("timeout", 2.0)


def test_a_wait_pauses_for_its_time() -> None:
    step, pose, time_s = play(Wait(1.0, 0.0))
    assert pose == (0, 0, 0)
    assert time_s == pytest.approx(1.0)
    assert step.covered == pytest.approx(1.0)
