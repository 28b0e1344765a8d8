"""Outlines of what stands in a world, seen from above."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

from executor.trying_events import MOST_OUTLINES

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np
    from numpy.typing import NDArray

    from executor.stream_messages import Scene, Shape

__all__ = ["outlines_of"]

ROUND_POINTS: Final = 16
LOW_M: Final = 0.02
"""What is not higher is part of the ground."""

Outline = list[tuple[float, float]]


def outlines_of(scene: Scene, poses: NDArray[np.float32] | None = None) -> list[Outline]:
    """Returns the corners in m of the shapes of all bodies but robots; walls, crates, and people.

    Args:
        scene: the world.
        poses: where its objects are now, by their number; None takes the places in the scene.
    """
    found: list[Outline] = []
    for number, thing in enumerate(scene.objects):
        if thing.kind == "robot":
            continue
        pose = thing.pose if poses is None else [float(value) for value in poses[number]]
        for shape in thing.shapes:
            corners = [] if shape.ceiling else _corners(shape)
            if corners and len(found) < MOST_OUTLINES:
                found.append([_rounded(_placed(_placed(corner, shape.pose), pose)) for corner in corners])
    return found


def _corners(shape: Shape) -> list[tuple[float, float, float]]:
    size = shape.size
    if shape.shape == "box" and size[2] > LOW_M:
        x, y = size[0] / 2, size[1] / 2
        return [(-x, -y, 0.0), (x, -y, 0.0), (x, y, 0.0), (-x, y, 0.0)]
    if shape.shape in ("cylinder", "sphere", "capsule"):
        turns = [math.tau * step / ROUND_POINTS for step in range(ROUND_POINTS)]
        return [(size[0] * math.cos(turn), size[0] * math.sin(turn), 0.0) for turn in turns]
    return []


def _placed(point: tuple[float, float, float], pose: Sequence[float]) -> tuple[float, float, float]:
    """Returns a point of a frame in the frame around it; the pose is [x, y, z, qx, qy, qz, qw]."""
    x, y, z = point
    px, py, pz, qx, qy, qz, qw = pose
    tx, ty, tz = 2 * (qy * z - qz * y), 2 * (qz * x - qx * z), 2 * (qx * y - qy * x)
    return (
        px + x + qw * tx + qy * tz - qz * ty,
        py + y + qw * ty + qz * tx - qx * tz,
        pz + z + qw * tz + qx * ty - qy * tx,
    )


def _rounded(point: tuple[float, float, float]) -> tuple[float, float]:
    return round(point[0], 3), round(point[1], 3)
