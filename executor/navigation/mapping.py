"""The exact occupancy grid of a world: what stands in the height of a robot, from the shapes of its scene."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from executor.navigation.grid import Grid
from executor.world.geometry.transforms import compose, rotation

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from numpy.typing import NDArray

    from executor.stream_messages import Mesh, Scene, SceneObject, Shape

    Points = NDArray[np.float64]

RESOLUTION_M: Final = 0.05
HEIGHTS_M: Final = (0.04, 0.4)
"""What is lower is driven over, what is higher is driven under."""
LEAST_RADIUS_M: Final = 0.1
BORDER_M: Final = 1.0
LONGEST_M: Final = 100.0
"""A map is not longer than this along one side."""
_CORNERS: Final = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
_CIRCLE: Final = np.array([(np.cos(a), np.sin(a)) for a in np.linspace(0, 2 * np.pi, 24, endpoint=False)])


def map_of(
    scene: Scene,
    *,
    around: tuple[float, float] = (0.0, 0.0),
    resolution: float = RESOLUTION_M,
    poses: Sequence[Sequence[float]] | NDArray[np.float32] | None = None,
) -> Grid:
    """Returns the grid of everything in a scene but its robots.

    Args:
        scene: the scene.
        around: a place within the grid.
        resolution: the side of a cell in m.
        poses: the present poses of the scene's objects; with None, those of the scene.
    """
    polygons = [polygon for polygon in _polygons(scene, poses) if len(polygon)]
    points = np.vstack([np.asarray([around]), *polygons])
    low = np.maximum(points.min(axis=0) - BORDER_M, np.asarray(around) - LONGEST_M / 2)
    high = np.minimum(points.max(axis=0) + BORDER_M, np.asarray(around) + LONGEST_M / 2)
    grid = Grid.empty((float(low[0]), float(low[1])), (float(high[0]), float(high[1])), resolution)
    for polygon in polygons:
        _fill(grid, polygon)
    return grid


def radius_of(scene: Scene, body: str, centre: tuple[float, float]) -> float:
    """Returns the radius of a circle round a robot's shapes, with its centre between the wheels."""
    corners = [
        points
        for thing in scene.objects
        if thing.kind == "robot" and thing.body == body
        for points in _outlines(thing, scene.meshes, thing.pose)
        if len(points)
    ]
    return max((float(np.hypot(*(points - centre).T).max()) for points in corners), default=LEAST_RADIUS_M)


def _polygons(
    scene: Scene, poses: Sequence[Sequence[float]] | NDArray[np.float32] | None
) -> Iterator[Points]:
    """Yields the corners of the convex outlines on the ground."""
    for index, thing in enumerate(scene.objects):
        if thing.kind != "robot":
            yield from _outlines(thing, scene.meshes, thing.pose if poses is None else poses[index])


def _outlines(
    thing: SceneObject, meshes: Mapping[str, Mesh], at: Sequence[float] | NDArray[np.float32]
) -> Iterator[Points]:
    for shape in thing.shapes:
        if not shape.ceiling:
            pose = compose(tuple(map(float, at)), tuple(shape.pose))  # type: ignore[arg-type]
            for points in _parts(shape, meshes):
                yield _outline(points @ rotation(pose[3:]).T + np.asarray(pose[:3]))


def _parts(shape: Shape, meshes: Mapping[str, Mesh]) -> Iterator[Points]:
    """Yields the corners of the convex parts of a shape, in its own frame."""
    size = shape.size
    match shape.shape:
        case "box":
            yield _CORNERS * np.asarray(size)
        case "cylinder" | "capsule":
            height = size[1] / 2 + (size[0] if shape.shape == "capsule" else 0.0)
            yield np.vstack([np.column_stack([_CIRCLE * size[0], np.full(24, z)]) for z in (-height, height)])
        case "sphere":
            rings = [(size[0], 0.0), (0.0, -size[0]), (0.0, size[0])]
            yield np.vstack([np.column_stack([_CIRCLE * r, np.full(24, z)]) for r, z in rings])
        case "mesh" if shape.mesh in meshes:
            mesh = meshes[shape.mesh]
            corners = np.frombuffer(mesh.positions, np.float32).reshape(-1, 3).astype(np.float64)
            triangles = np.frombuffer(mesh.indices, np.uint32).reshape(-1, 3)
            yield from (corners * np.asarray(size))[triangles]
        case _:
            return


def _outline(points: Points) -> Points:
    """Returns the points on the ground if any part is in the height of a robot; none otherwise."""
    low, high = points[:, 2].min(), points[:, 2].max()
    return points[:, :2] if low < HEIGHTS_M[1] and high > HEIGHTS_M[0] else np.zeros((0, 2))


def _fill(grid: Grid, points: Points) -> None:
    """Marks the cells whose centre is within the hull of the points, or within half a cell of it."""
    hull = _hull(points)
    margin = grid.resolution / 2
    low = np.floor((hull.min(axis=0) - margin - grid.origin) / grid.resolution).astype(int)
    high = np.ceil((hull.max(axis=0) + margin - grid.origin) / grid.resolution).astype(int)
    rows, columns = grid.occupied.shape
    left, right = max(low[0], 0), min(high[0], columns)
    bottom, top = max(low[1], 0), min(high[1], rows)
    if left >= right or bottom >= top:
        return
    x = grid.origin[0] + (np.arange(left, right) + 0.5) * grid.resolution
    y = grid.origin[1] + (np.arange(bottom, top) + 0.5) * grid.resolution
    centre_x, centre_y = np.meshgrid(x, y)
    inside = np.ones(centre_x.shape, np.bool_)
    for start, end in zip(hull, np.roll(hull, -1, axis=0), strict=True):
        along = end - start
        length = float(np.hypot(*along))
        if length > 0:
            side = (along[0] * (centre_y - start[1]) - along[1] * (centre_x - start[0])) / length
            inside &= side >= -margin
    grid.occupied[bottom:top, left:right] |= inside


def _hull(points: Points) -> Points:
    """Returns the convex hull, counter-clockwise (Andrew's monotone chain)."""
    ordered = sorted({(float(x), float(y)) for x, y in points})
    if len(ordered) < 3:
        return np.asarray(ordered)
    lower, upper = _chain(ordered), _chain(ordered[::-1])
    return np.asarray(lower[:-1] + upper[:-1])


def _chain(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    chain: list[tuple[float, float]] = []
    for point in points:
        while len(chain) >= 2 and _turn(chain[-2], chain[-1], point) <= 0:
            chain.pop()
        chain.append(point)
    return chain


def _turn(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
