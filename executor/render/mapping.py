"""Texture coordinates of shapes: a repetition has the size of its texture in the world.

The browser's 3D view does the same (`frontend/src/features/viewer/mapping.ts`). Flat faces are projected
along their dominant axis, from the shape's lowest corner. Cylinders and spheres are wrapped, with the nearest
whole number of repetitions.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float32]

FLAT: Final = 0.99
"""Texture coordinates of shapes: one repetition has the size of its texture in the world."""


def coordinates(kind: str, points: Floats, normals: Floats, tile: tuple[float, float]) -> Floats:
    """Returns the texture coordinates of each vertex; 1 is one repetition, and v points up.

    Args:
        kind: `box`, `plane`, `cylinder`, `sphere`, `capsule` or `mesh`.
        points: the vertices in m, in the shape's frame; three rows for each triangle.
        normals: the normals of the vertices.
        tile: width and height of a repetition in m.
    """
    uvs = _along_axes(points, normals, tile)
    if kind in ("cylinder", "sphere", "capsule"):
        is_side = np.abs(normals[:, 2]) < FLAT if kind == "cylinder" else np.ones(len(points), bool)
        uvs[is_side] = _wrapped(points[is_side], tile, is_ball=kind == "sphere")
    return uvs


def _along_axes(points: Floats, normals: Floats, tile: tuple[float, float]) -> Floats:
    """Projects each triangle along its dominant axis."""
    corners = points.reshape(-1, 3, 3)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    flat = np.where(np.abs(across).max(axis=1, keepdims=True) > 0, across, normals.reshape(-1, 3, 3)[:, 0])
    axis = np.repeat(np.abs(flat).argmax(axis=1), 3)
    sign = np.repeat(np.sign(flat[np.arange(len(flat)), np.abs(flat).argmax(axis=1)]), 3)
    low, high = points.min(axis=0), points.max(axis=0)
    x, y, z = (points - low).T
    width, depth = high[0] - low[0], high[1] - low[1]
    # Textures are oriented so that none is mirrored when seen from outside.
    u = np.select(
        [axis == 0, axis == 1],
        [np.where(sign > 0, y, depth - y), np.where(sign > 0, width - x, x)],
        np.where(sign < 0, width - x, x),
    )
    v = np.where(axis == 2, y, z)
    return np.stack([u / tile[0], v / tile[1]], axis=1).astype(np.float32)


def _wrapped(points: Floats, tile: tuple[float, float], *, is_ball: bool) -> Floats:
    """Wraps the texture around the z axis, from -x on; triangles that cross the seam continue beyond 1."""
    radius = float(np.linalg.norm(points[:, :2], axis=1).max(initial=0.0))
    times = max(1, round(2 * math.pi * radius / tile[0]))
    around = np.hypot(points[:, 0], points[:, 1])
    turns = np.arctan2(points[:, 1], points[:, 0]).reshape(-1, 3) / (2 * math.pi)
    at_pole = (around < 1e-6 * max(radius, 1e-9)).reshape(-1, 3)
    known = np.where(at_pole, np.nan, turns)
    first = np.take_along_axis(turns, np.argmin(at_pole, axis=1)[:, None], axis=1)
    turns = first + np.remainder(known - first + 0.5, 1.0) - 0.5
    turns = np.where(at_pole, np.nanmean(turns, axis=1, keepdims=True), turns)
    z = points[:, 2]
    if is_ball:
        up = np.arctan2(z, around) * radius
        rounds = max(1, round(math.pi * radius / tile[1]))
        v = (up / (math.pi * max(radius, 1e-9)) + 0.5) * rounds
    else:
        v = (z - z.min(initial=0.0)) / tile[1]
    return np.stack([turns.ravel() * times, v], axis=1).astype(np.float32)
