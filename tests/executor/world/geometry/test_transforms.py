import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from executor.world.geometry.transforms import (
    IDENTITY,
    Pose,
    compose,
    from_xyz_rpy,
    inverse,
    quaternion_about,
    rotate,
    to_xyz_rpy,
    wrap,
    yaw_of,
)

numbers = st.floats(-10, 10)
poses = st.tuples(numbers, numbers, numbers, numbers, numbers, numbers).map(from_xyz_rpy)


@given(poses)
def test_a_pose_and_its_inverse_cancel(pose: Pose) -> None:
    x, y, z, qx, qy, qz, qw = compose(pose, inverse(pose))
    assert (x, y, z) == pytest.approx((0, 0, 0), abs=1e-9)
    assert (qx, qy, qz, abs(qw)) == pytest.approx((0, 0, 0, 1), abs=1e-9)


@given(poses, poses, st.tuples(numbers, numbers, numbers))
def test_composing_is_rotating_twice(a: Pose, b: Pose, v: tuple[float, float, float]) -> None:
    once = rotate(compose(a, b)[3:], v)
    assert once == pytest.approx(rotate(a[3:], rotate(b[3:], v)), abs=1e-7)


def test_roll_pitch_yaw_are_about_fixed_axes() -> None:
    pose = from_xyz_rpy((0, 0, 0, math.pi / 2, 0, math.pi / 2))
    assert rotate(pose[3:], (0, 0, 1)) == pytest.approx((1, 0, 0), abs=1e-12)
    assert rotate(quaternion_about((0, 0, 2), math.pi / 2), (1, 0, 0)) == pytest.approx((0, 1, 0), abs=1e-12)


@given(st.floats(-3.1, 3.1))
def test_yaw_is_read_back(yaw: float) -> None:
    assert yaw_of(from_xyz_rpy((0, 0, 0, 0, 0, yaw))[3:]) == pytest.approx(yaw)
    assert wrap(yaw + 4 * math.pi) == pytest.approx(yaw)


@given(numbers, st.one_of(numbers, st.sampled_from([math.pi / 2, -math.pi / 2])), numbers)
def test_roll_pitch_yaw_are_read_back_also_when_it_points_straight_up(
    roll: float, pitch: float, yaw: float
) -> None:
    pose = from_xyz_rpy((1, 2, 3, roll, pitch, yaw))
    again = from_xyz_rpy(to_xyz_rpy(pose))
    for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
        assert rotate(again[3:], axis) == pytest.approx(rotate(pose[3:], axis), abs=1e-5)


def test_identity() -> None:
    assert compose(IDENTITY, IDENTITY) == IDENTITY
