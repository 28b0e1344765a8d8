"""Rigid transforms on plain tuples: position and unit quaternion, as [x, y, z, qx, qy, qz, qw]."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Pose = tuple[float, float, float, float, float, float, float]

IDENTITY: Final[Pose] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
_STRAIGHT_UP: Final = 1 - 1e-12
"""Sine of the pitch above which roll and yaw cannot be distinguished."""


def quaternion_from_rpy(roll: float, pitch: float, yaw: float) -> Quaternion:
    """Returns the rotation about the fixed axes: first x, then y, then z."""
    sr, cr = math.sin(roll / 2), math.cos(roll / 2)
    sp, cp = math.sin(pitch / 2), math.cos(pitch / 2)
    sy, cy = math.sin(yaw / 2), math.cos(yaw / 2)
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def quaternion_about(axis: Sequence[float], angle: float) -> Quaternion:
    """Returns the rotation by an angle about an axis."""
    length = math.sqrt(axis[0] ** 2 + axis[1] ** 2 + axis[2] ** 2) or 1.0
    s = math.sin(angle / 2) / length
    return axis[0] * s, axis[1] * s, axis[2] * s, math.cos(angle / 2)


def multiply(a: Sequence[float], b: Sequence[float]) -> Quaternion:
    """Returns the rotation that applies `b`, then `a`."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def rotate(q: Sequence[float], v: Sequence[float]) -> Vector:
    """Returns a rotated vector."""
    qx, qy, qz, qw = q
    x, y, z = v
    tx, ty, tz = 2 * (qy * z - qz * y), 2 * (qz * x - qx * z), 2 * (qx * y - qy * x)
    return (
        x + qw * tx + qy * tz - qz * ty,
        y + qw * ty + qz * tx - qx * tz,
        z + qw * tz + qx * ty - qy * tx,
    )


def compose(a: Pose, b: Pose) -> Pose:
    """Transforms the pose `b` from the frame of `a` into the parent frame of `a`."""
    x, y, z = rotate(a[3:], b[:3])
    return (a[0] + x, a[1] + y, a[2] + z, *multiply(a[3:], b[3:]))


def inverse(pose: Pose) -> Pose:
    """Returns the inverse transform."""
    q = (-pose[3], -pose[4], -pose[5], pose[6])
    x, y, z = rotate(q, pose[:3])
    return (-x, -y, -z, *q)


def from_xyz_rpy(values: Sequence[float]) -> Pose:
    """Returns the pose of [x, y, z, roll, pitch, yaw]."""
    x, y, z, roll, pitch, yaw = values
    return (x, y, z, *quaternion_from_rpy(roll, pitch, yaw))


def rotation(q: Sequence[float]) -> NDArray[np.float64]:
    """Returns the 3×3 matrix of a rotation."""
    x, y, z, w = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def to_xyz_rpy(pose: Pose) -> tuple[float, float, float, float, float, float]:
    """Returns the values [x, y, z, roll, pitch, yaw] of a pose."""
    qx, qy, qz, qw = pose[3:]
    sine = 2 * (qw * qy - qz * qx)
    if abs(sine) > _STRAIGHT_UP:  # gimbal lock: roll and yaw share an axis, so all is yaw
        return (
            *pose[:3],
            0.0,
            math.copysign(math.pi / 2, sine),
            wrap(-2 * math.copysign(1, sine) * math.atan2(qx, qw)),
        )
    roll = math.atan2(2 * (qw * qx + qy * qz), 1 - 2 * (qx * qx + qy * qy))
    return (*pose[:3], roll, math.asin(sine), yaw_of(pose[3:]))


def yaw_of(q: Sequence[float]) -> float:
    """Returns the heading of a rotation, in rad."""
    qx, qy, qz, qw = q
    return math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz))


def wrap(angle: float) -> float:
    """Normalizes an angle to the range -pi to pi."""
    return math.atan2(math.sin(angle), math.cos(angle))
