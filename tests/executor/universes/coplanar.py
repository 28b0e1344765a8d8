"""Finds overlapping faces in one plane that face the same way: which of them is visible is then undefined."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import cv2
import numpy as np

from executor.render.pieces import Pieces, matrices

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from executor.messages import Scene

    Floats = NDArray[np.float64]

APART_M: Final = 0.0018
"""Nearer than this, two faces are one for a depth buffer of 24 bits that begins at 5 cm, 30 m away."""
ON_ROBOTS_M: Final = 0.0004
"""The same within a robot, whose details are seen from nearer: 15 m."""
SAME_WAY: Final = 0.99999
LEAST_AREA_M2: Final = 1e-5
OUTSIDE_M: Final = 0.001


@dataclass(frozen=True)
class _Piece:
    name: str
    look: tuple[object, ...]
    is_convex: bool
    is_robot: bool
    corners: Floats
    """(n, 3, 3): of each triangle."""
    normals: Floats
    offsets: Floats

    @property
    def low(self) -> Floats:
        return np.asarray(self.corners.min(axis=(0, 1)))

    @property
    def high(self) -> Floats:
        return np.asarray(self.corners.max(axis=(0, 1)))

    def holds(self, points: Floats) -> bool:
        """Returns whether it contains all points."""
        if not self.is_convex:
            return False
        return bool((points @ self.normals.T - self.offsets < -1e-6).all())


def overlapping(scene: Scene, poses: NDArray[np.float32]) -> list[str]:
    """Yields the pairs of shapes with overlapping faces, each with the area in cm².

    People are left out: they walk, so their overlaps are only momentary.
    """
    pieces = [piece for piece in _pieces(scene, poses) if len(piece.corners)]
    found = []
    for one, other in _neighbours(pieces):
        area = sum(
            area
            for area, points in _common(one, other)
            if not any(piece.holds(points) for piece in pieces if piece is not one and piece is not other)
        )
        if area > LEAST_AREA_M2:
            found.append(f"{one.name} {one.look[:3]} and {other.name} {other.look[:3]}: {area * 1e4:.1f} cm²")
    return found


def _pieces(scene: Scene, poses: NDArray[np.float32]) -> Iterator[_Piece]:
    stock, placed = Pieces(scene), matrices(poses)
    shapes = [(thing, shape) for thing in scene.objects for shape in thing.shapes]
    for number, (thing, shape) in enumerate(shapes):
        if thing.kind == "actor":
            continue
        vertices = stock.vertices[stock.order_of(np.array([number]), np.array([0]))]["position"]
        turn = placed[stock.rows[number]].astype(float)
        name = f"{thing.body}/{thing.link}" if thing.link else thing.body
        look = (*shape.color, shape.texture)
        points = vertices @ turn[:, :3].T + turn[:, 3]
        is_convex = shape.shape not in ("mesh", "plane")
        yield _piece(name, look, points, is_convex=is_convex, is_robot=thing.kind == "robot")
    half = 100.0
    square = [(-half, -half), (half, -half), (half, half), (-half, -half), (half, half), (-half, half)]
    floor = np.array([(x, y, 0.0) for x, y in square])
    yield _piece("the ground", (*scene.ground_color, scene.ground_texture), floor)


def _piece(
    name: str, look: tuple[object, ...], points: Floats, *, is_convex: bool = False, is_robot: bool = False
) -> _Piece:
    corners = points.reshape(-1, 3, 3)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(across, axis=1)
    corners, normals = corners[length > 1e-12], across[length > 1e-12] / length[length > 1e-12, None]
    offsets = np.einsum("ni,ni->n", normals, corners[:, 0])
    return _Piece(name, look, is_convex, is_robot, corners, normals, offsets)


def _neighbours(pieces: list[_Piece]) -> Iterator[tuple[_Piece, _Piece]]:
    """Yields the pairs that touch and differ in looks: with equal colours the order is invisible."""
    lows = np.array([piece.low for piece in pieces]) - APART_M
    highs = np.array([piece.high for piece in pieces]) + APART_M
    for i, j in itertools.combinations(range(len(pieces)), 2):
        if (lows[i] < highs[j]).all() and (lows[j] < highs[i]).all():
            one, other = pieces[i], pieces[j]
            if one.look != other.look or one.look[-1]:
                yield one, other


def _common(one: _Piece, other: _Piece) -> Iterator[tuple[float, Floats]]:
    """Returns the intersection of two pieces: its area, and points just in front of it."""
    same_way = one.normals @ other.normals.T > SAME_WAY
    limit = ON_ROBOTS_M if one.is_robot and other.is_robot else APART_M
    apart = np.abs(one.offsets[:, None] - other.offsets[None, :])
    for i, j in np.argwhere(same_way & (apart < limit)):
        normal = one.normals[i]
        u = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0])
        u /= np.linalg.norm(u)
        axes = np.stack([u, np.cross(normal, u)], axis=1)
        middle = one.corners[i].mean(axis=0)
        flat: list[Any] = [
            ((c - middle) @ axes).astype(np.float32) for c in (one.corners[i], other.corners[j])
        ]
        area, outline = cv2.intersectConvexConvex(*flat)
        if area < LEAST_AREA_M2 / 100 or outline is None:
            continue
        corners = outline.reshape(-1, 2).astype(float)
        corners = corners.mean(axis=0) + (corners - corners.mean(axis=0)) * 0.98
        in_front = corners @ axes.T + middle + normal * (OUTSIDE_M + APART_M)
        if (in_front[:, 2] > 0).any():
            yield float(area), in_front
