"""Triangles of primitive shapes: vertices with normals, as float32 rows [x, y, z, nx, ny, nz]."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any, Final

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Vertices = NDArray[np.float32]

SEGMENTS: Final = 24


def indexed(vertices: Vertices) -> tuple[Vertices, NDArray[np.uint32]]:
    """Returns the unique vertices, and the indices of the triangles; triangles without area are left out."""
    unique, inverse = np.unique(np.round(vertices, 6), axis=0, return_inverse=True)
    order = inverse.reshape(-1, 3)
    # At the poles of round shapes, vertices have one position and different normals.
    corners = unique[order, :3]
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).min(axis=1, initial=np.inf)
    return unique.astype(np.float32), order[sides > 0].ravel().astype(np.uint32)


def grid(count: int) -> Vertices:
    """Returns a square with edges of 1 m, divided into `count` by `count` pieces."""
    whole, pieces = square(), []
    for i in range(count):
        for j in range(count):
            piece = whole.copy()
            piece[:, 0] = (piece[:, 0] + 0.5 + i) / count - 0.5
            piece[:, 1] = (piece[:, 1] + 0.5 + j) / count - 0.5
            pieces.append(piece)
    return np.concatenate(pieces)


def box() -> Vertices:
    """Returns a cube with edges of 1 m around the origin."""
    triangles = []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            normal, u, v = np.zeros(3), np.zeros(3), np.zeros(3)
            normal[axis] = sign
            u[(axis + 1) % 3] = 1.0
            v[(axis + 2) % 3] = sign
            corners = [normal / 2 + a * u / 2 + b * v / 2 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
            triangles += [(corners[i], normal) for i in (0, 1, 2, 0, 2, 3)]
    return _pack(triangles)


def square() -> Vertices:
    """Returns a square with edges of 1 m in the xy plane, seen from above."""
    up = np.array([0.0, 0.0, 1.0])
    corners = [np.array([a / 2, b / 2, 0.0]) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return _pack([(corners[i], up) for i in (0, 1, 2, 0, 2, 3)])


def cylinder(segments: int = SEGMENTS) -> Vertices:
    """Returns a cylinder of radius 1 m and length 1 m along z, around the origin."""
    triangles: list[tuple[Any, Any]] = []
    circle = _circle(segments)
    up = np.array([0.0, 0.0, 1.0])
    half = up / 2
    for a, b in itertools.pairwise(circle):
        triangles += [
            (a - half, a),
            (b - half, b),
            (b + half, b),
            (a - half, a),
            (b + half, b),
            (a + half, a),
        ]
        triangles += [(half, up), (a + half, up), (b + half, up)]
        triangles += [(-half, -up), (b - half, -up), (a - half, -up)]
    return _pack(triangles)


def capsule(radius: float, length: float, segments: int = SEGMENTS) -> Vertices:
    """Returns a cylinder along z, closed by two half spheres; a sphere if the length is 0."""
    rings = max(2, (segments + 2) // 4 - (length > 0))
    latitudes = [-math.pi / 2 + math.pi / 2 * i / rings for i in range(rings + 1)]
    rows = [(lat, -length / 2) for lat in latitudes] + [(-lat, length / 2) for lat in reversed(latitudes)]
    if length <= 0:
        rows = rows[: rings + 1] + rows[rings + 2 :]
    triangles: list[tuple[Any, Any]] = []
    circle = _circle(segments)
    for (lat0, z0), (lat1, z1) in itertools.pairwise(rows):
        for c0, c1 in itertools.pairwise(circle):
            normals = [_on_sphere(c0, lat0), _on_sphere(c1, lat0), _on_sphere(c1, lat1), _on_sphere(c0, lat1)]
            points = [n * radius + (0, 0, z) for n, z in zip(normals, (z0, z0, z1, z1), strict=True)]
            triangles += [(points[i], normals[i]) for i in (0, 1, 2, 0, 2, 3)]
    return _pack(triangles)


def from_mesh(positions: bytes, normals: bytes, indices: bytes) -> Vertices:
    """Returns the triangles of a mesh."""
    points = np.frombuffer(positions, "<f4").reshape(-1, 3)
    directions = np.frombuffer(normals, "<f4").reshape(-1, 3)
    order = np.frombuffer(indices, "<u4")
    return np.hstack([points[order], directions[order]]).astype(np.float32)


def _circle(segments: int) -> list[NDArray[np.float64]]:
    angles = [2 * math.pi * i / segments for i in range(segments + 1)]
    return [np.array([math.cos(angle), math.sin(angle), 0.0]) for angle in angles]


def _on_sphere(around: NDArray[np.float64], latitude: float) -> NDArray[np.float64]:
    point: NDArray[np.float64] = around * math.cos(latitude) + np.array([0.0, 0.0, math.sin(latitude)])
    return point


def _pack(triangles: list[tuple[Any, Any]]) -> Vertices:
    return np.array([np.concatenate([point, normal]) for point, normal in triangles], np.float32)
