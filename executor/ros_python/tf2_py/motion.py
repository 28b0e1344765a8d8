"""Rigid motions: a translation in m and a unit quaternion (x, y, z, w)."""

from __future__ import annotations

import math
from typing import NamedTuple

Vector = tuple[float, float, float]
Turn = tuple[float, float, float, float]

_NEARLY_PARALLEL = 1.0 - 1e-9


class Motion(NamedTuple):
    """A translation and a rotation; it transforms a point from the child's frame into the parent's."""

    translation: Vector = (0.0, 0.0, 0.0)
    rotation: Turn = (0.0, 0.0, 0.0, 1.0)


def compose(outer: Motion, inner: Motion) -> Motion:
    """Returns the motion that applies `inner`, then `outer`."""
    moved = rotate(outer.rotation, inner.translation)
    x, y, z = (a + b for a, b in zip(outer.translation, moved, strict=True))
    return Motion((x, y, z), multiply(outer.rotation, inner.rotation))


def inverse(motion: Motion) -> Motion:
    """Returns the inverse motion."""
    x, y, z, w = motion.rotation
    back = (-x, -y, -z, w)
    dx, dy, dz = rotate(back, motion.translation)
    return Motion((-dx, -dy, -dz), back)


def multiply(a: Turn, b: Turn) -> Turn:
    """Returns the product of two quaternions, normalised."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return normalised(
        (
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
            aw * bw - ax * bx - ay * by - az * bz,
        )
    )


def rotate(turn: Turn, vector: Vector) -> Vector:
    """Returns a rotated vector."""
    x, y, z, w = turn
    vx, vy, vz = vector
    # v + 2w (q × v) + 2 q × (q × v)
    cx, cy, cz = y * vz - z * vy, z * vx - x * vz, x * vy - y * vx
    return (
        vx + 2 * (w * cx + y * cz - z * cy),
        vy + 2 * (w * cy + z * cx - x * cz),
        vz + 2 * (w * cz + x * cy - y * cx),
    )


def normalised(turn: Turn) -> Turn:
    """Returns a quaternion of length 1."""
    length = math.sqrt(sum(part * part for part in turn))
    x, y, z, w = (part / length for part in turn)
    return x, y, z, w


def between(before: Motion, after: Motion, share: float) -> Motion:
    """Interpolates between two motions: the translation linearly, the rotation at a constant rate (slerp)."""
    x, y, z = (a + share * (b - a) for a, b in zip(before.translation, after.translation, strict=True))
    return Motion((x, y, z), _slerp(before.rotation, after.rotation, share))


def _slerp(a: Turn, b: Turn, share: float) -> Turn:
    cosine = sum(p * q for p, q in zip(a, b, strict=True))
    sign = -1.0 if cosine < 0 else 1.0  # q and -q are the same rotation; this selects the shorter arc
    cosine = min(1.0, abs(cosine))
    if cosine > _NEARLY_PARALLEL:
        first, second = 1.0 - share, share
    else:
        angle = math.acos(cosine)
        first, second = (math.sin(part * angle) / math.sin(angle) for part in (1.0 - share, share))
    x, y, z, w = (first * p + sign * second * q for p, q in zip(a, b, strict=True))
    return normalised((x, y, z, w))
