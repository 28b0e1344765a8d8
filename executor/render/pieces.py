"""A scene as one buffer of triangles, and the selection of visible ones. Numpy only."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Final

import numpy as np

from executor.render import geometry, mapping

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.messages import Scene, Shape
    from executor.render.interface import Viewpoint
    from executor.render.rectangles import Rectangle

    Floats = NDArray[np.float32]
    Order = NDArray[np.uint32]

VERTEX: Final = np.dtype(
    [("position", "<f4", 3), ("normal", "<f4", 3), ("color", "u1", 4), ("row", "<f4")], align=False
)
"""One vertex: position in m and normal in the object's frame, colour in sRGB, and row of the object."""

SEGMENTS: Final = (24, 16, 10, 6)
LEVELS_PX: Final = (4.0, 9.0, 22.0)
"""Radii in pixels below which round shapes get fewer triangles; the error is at most half a pixel."""
SMALLEST_PX: Final = 0.5


class Pieces:
    """All shapes of a scene, one piece for each shape, in up to four levels of detail.

    Attributes:
        vertices: all vertices of all levels, as `VERTEX`.
        uvs: texture coordinates of each vertex as u, v and layer; empty without textures.
        rows: for each piece, the row of its object in the scene.
        lows, highs: for each piece, the corners of its bounding box in the object's frame.
    """

    def __init__(self, scene: Scene) -> None:
        shapes = [(row, shape) for row, thing in enumerate(scene.objects) for shape in thing.shapes]
        self.rows = np.array([row for row, _ in shapes], np.intp)
        self.is_flat = np.array([shape.shape == "plane" for _, shape in shapes], bool)
        self.is_ceiling = np.array([shape.ceiling for _, shape in shapes], bool)
        self._orders: list[list[Order]] = []
        # The textures are layers of one stack, in the order of their names.
        self.layers = {name: layer for layer, name in enumerate(sorted(scene.textures))}
        self.is_textured = np.array([bool(shape.texture) for _, shape in shapes], bool)
        made: dict[tuple[object, ...], list[tuple[Floats, Order]]] = {}
        stock: list[NDArray[np.void]] = []
        uvs: list[Floats] = []
        total = 0
        for row, shape in shapes:
            key = _key(shape)
            if key not in made:
                made[key] = [geometry.indexed(vertices) for vertices in _painted(shape, scene)]
            orders: list[Order] = []
            for points, order in made[key]:
                stock.append(_placed(points, shape, row))
                uvs.append(_uvs(points, self.layers.get(shape.texture, 0)))
                orders.append(order + np.uint32(total))
                total += len(points)
            self._orders.append([orders[min(level, len(orders) - 1)] for level in range(len(SEGMENTS))])
        self.vertices = np.concatenate(stock) if stock else np.zeros(0, VERTEX)
        self.uvs = np.concatenate(uvs) if self.is_textured.any() else np.zeros((0, 3), np.float32)
        boxes = [_box(placed["position"]) for placed in _first_levels(stock, made, shapes)]
        self.lows = np.array([low for low, _ in boxes], np.float32).reshape(-1, 3)
        self.highs = np.array([high for _, high in boxes], np.float32).reshape(-1, 3)
        self._middles = (self.lows + self.highs) / 2
        # The radius by which the level of detail is chosen.
        self.rounds: Floats = (np.sort(self.highs - self.lows, axis=1)[:, 1] / 2).astype(np.float32)
        self.radii: Floats = (np.linalg.norm(self.highs - self.lows, axis=1) / 2).astype(np.float32)

    def __len__(self) -> int:
        return len(self.rows)

    def largest_order(self) -> int:
        """Returns the number of indices of all pieces in their highest level of detail."""
        return sum(max(len(order) for order in orders) for orders in self._orders)

    def centers(self, placed: Floats) -> Floats:
        """Returns the center of each piece in the world; `placed` holds the objects' matrices."""
        turned = placed[self.rows]
        centers: Floats = np.einsum("nij,nj->ni", turned[:, :, :3], self._middles) + turned[:, :, 3]
        return centers

    def corners(self, placed: Floats) -> NDArray[np.float64]:
        """Returns the eight corners of each piece's box in the world, one after the other."""
        turned = placed[self.rows].astype(np.float64)
        ends = np.stack([self.lows, self.highs], axis=1)
        corners = [ends[:, pick, np.arange(3)] for pick in itertools.product((0, 1), repeat=3)]
        return np.concatenate(
            [np.einsum("nij,nj->ni", turned[:, :, :3], corner) + turned[:, :, 3] for corner in corners]
        )

    def corners_of(self, numbers: NDArray[np.intp], placed: Floats, margin: float) -> NDArray[np.float64]:
        """Returns the corners in the world of some pieces' boxes, enlarged by a margin: (pieces, 8, 3)."""
        turned = placed[self.rows[numbers]].astype(np.float64)
        ends = np.stack([self.lows[numbers] - margin, self.highs[numbers] + margin], axis=1)
        corners = np.stack(
            [ends[:, pick, np.arange(3)] for pick in itertools.product((0, 1), repeat=3)], axis=1
        )
        placed_corners: NDArray[np.float64] = np.einsum("nij,nkj->nki", turned[:, :, :3], corners)
        placed_corners += turned[:, None, :, 3]
        return placed_corners

    def seen(self, placed: Floats, view: Viewpoint, width: int, height: int) -> Order:
        """Returns the triangles that may be visible, the nearest pieces first."""
        return self.order_of(*self._nearest(placed, view, width, height))

    def seen_apart(
        self, placed: Floats, view: Viewpoint, width: int, height: int, part: Rectangle | None = None
    ) -> tuple[Order, Order]:
        """Returns the visible triangles in two parts: those without and those with textures.

        Args:
            placed: the objects' matrices.
            view: the camera.
            width: the width of the picture in pixels.
            height: the height of the picture in pixels.
            part: restricts the triangles to this part of the picture; rows count from the top.
        """
        nearest, levels = self._nearest(placed, view, width, height, part)
        textured = self.is_textured[nearest]
        return (
            self.order_of(nearest[~textured], levels[~textured]),
            self.order_of(nearest[textured], levels[textured]),
        )

    def _nearest(
        self, placed: Floats, view: Viewpoint, width: int, height: int, part: Rectangle | None = None
    ) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Returns the pieces that may be visible, the nearest first, and their levels of detail."""
        if not len(self):
            return np.zeros(0, np.intp), np.zeros(0, np.intp)
        matrix = view.view_matrix().astype(np.float32)
        eye = self.centers(placed) @ matrix[:3, :3].T + matrix[:3, 3]
        ahead, radii = -eye[:, 2], self.radii
        wide = math.tan(view.fov / 2)
        scale = (width / 2 / wide) / np.maximum(ahead, view.near)
        pixels = radii * scale
        shown = (ahead > view.near - radii) & (ahead < view.far + radii) & (pixels > SMALLEST_PX)
        if view.roofless:
            shown &= ~self.is_ceiling
        x, y, across, down = part or (0, 0, width, height)
        pixel = 2 * wide / width
        for side, slope in (
            (-eye[:, 0], (width / 2 - x) * pixel),
            (eye[:, 0], (x + across - width / 2) * pixel),
            (eye[:, 1], (height / 2 - y) * pixel),
            (-eye[:, 1], (y + down - height / 2) * pixel),
        ):
            shown &= side < ahead * slope + radii * math.sqrt(1 + slope * slope)
        numbers = np.flatnonzero(shown)
        nearest = numbers[np.argsort(self._distances(placed, numbers, view.eye))]
        levels = len(SEGMENTS) - 1 - np.searchsorted(LEVELS_PX, (self.rounds * scale)[nearest])
        return nearest, levels

    def order_of(self, numbers: NDArray[np.intp], levels: NDArray[np.intp]) -> Order:
        """Returns the triangles of pieces, each in its level of detail."""
        if not len(numbers):
            return np.zeros(0, np.uint32)
        orders = self._orders
        pairs = zip(numbers.tolist(), levels.tolist(), strict=True)
        return np.concatenate([orders[number][level] for number, level in pairs])

    def _distances(
        self, placed: Floats, numbers: NDArray[np.intp], eye: tuple[float, float, float]
    ) -> Floats:
        """Returns the distance from the eye to the bounding box of each piece."""
        turned = placed[self.rows[numbers]]
        local = np.einsum("nji,nj->ni", turned[:, :, :3], np.array(eye, np.float32) - turned[:, :, 3])
        apart = local - np.clip(local, self.lows[numbers], self.highs[numbers])
        distances: Floats = np.einsum("ni,ni->n", apart, apart)
        return distances


def matrices(poses: Floats) -> Floats:
    """Returns the 3×4 matrices of poses [x, y, z, qx, qy, qz, qw], one for each row."""
    x, y, z, w = poses[:, 3], poses[:, 4], poses[:, 5], poses[:, 6]
    result = np.empty((len(poses), 3, 4), np.float32)
    result[:, 0, 0] = 1 - 2 * (y * y + z * z)
    result[:, 0, 1] = 2 * (x * y - z * w)
    result[:, 0, 2] = 2 * (x * z + y * w)
    result[:, 1, 0] = 2 * (x * y + z * w)
    result[:, 1, 1] = 1 - 2 * (x * x + z * z)
    result[:, 1, 2] = 2 * (y * z - x * w)
    result[:, 2, 0] = 2 * (x * z - y * w)
    result[:, 2, 1] = 2 * (y * z + x * w)
    result[:, 2, 2] = 1 - 2 * (x * x + y * y)
    result[:, :, 3] = poses[:, :3]
    return result


def _first_levels(
    stock: list[NDArray[np.void]],
    made: dict[tuple[object, ...], list[tuple[Floats, Order]]],
    shapes: list[tuple[int, Shape]],
) -> list[NDArray[np.void]]:
    firsts, at = [], 0
    for _, shape in shapes:
        firsts.append(stock[at])
        at += len(made[_key(shape)])
    return firsts


def _box(positions: Floats) -> tuple[Floats, Floats]:
    if not len(positions):
        return np.zeros(3, np.float32), np.zeros(3, np.float32)
    return positions.min(axis=0), positions.max(axis=0)


def _placed(points: Floats, shape: Shape, row: int) -> NDArray[np.void]:
    """Returns the vertices of a shape in the frame of its object."""
    turn = matrices(np.array([shape.pose], np.float32))[0]
    scale = np.array(_scale(shape), np.float32)
    normals = points[:, 3:6] / scale
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
    result = np.zeros(len(points), VERTEX)
    result["position"] = points[:, :3] * scale @ turn[:, :3].T + turn[:, 3]
    # Light comes from above: a ceiling is lit like a floor.
    result["normal"] = (0, 0, -1) if shape.ceiling and shape.shape == "plane" else normals @ turn[:, :3].T
    result["color"] = np.round(np.clip(shape.color, 0.0, 1.0) * np.float32(255)).astype(np.uint8)
    result["row"] = row
    return result


def _key(shape: Shape) -> tuple[object, ...]:
    """Returns the key of a shape's triangles.

    A textured shape has a key for each size, so that the texture is not stretched.
    """
    return (*_mesh_key(shape), shape.texture, *shape.size) if shape.texture else _mesh_key(shape)


def _painted(shape: Shape, scene: Scene) -> list[Floats]:
    """Returns the triangles of a shape in each level of detail.

    Textured shapes have two more columns for texture coordinates.
    """
    levels = _levels(_mesh_key(shape), scene)
    if not shape.texture:
        return levels
    mesh = scene.meshes[shape.mesh] if shape.shape == "mesh" else None
    if mesh is not None and mesh.uvs:
        order = np.frombuffer(mesh.indices, "<u4")
        return [np.hstack([levels[0], np.frombuffer(mesh.uvs, "<f4").reshape(-1, 2)[order]])]
    width, height = scene.textures[shape.texture].tile
    scale = np.array(_scale(shape), np.float32)
    return [
        np.hstack(
            [level, mapping.coordinates(shape.shape, level[:, :3] * scale, level[:, 3:6], (width, height))]
        )
        for level in levels
    ]


def _uvs(points: Floats, layer: int) -> Floats:
    result = np.zeros((len(points), 3), np.float32)
    result[:, : points.shape[1] - 6] = points[:, 6:]
    result[:, 2] = layer
    return result


def _mesh_key(shape: Shape) -> tuple[object, ...]:
    # Stretching would distort the ends of a capsule, so each size is a separate mesh.
    if shape.shape == "capsule":
        return ("capsule", *shape.size)
    return (shape.shape, shape.mesh) if shape.shape == "mesh" else (shape.shape,)


def _levels(key: tuple[object, ...], scene: Scene) -> list[Floats]:
    match key:
        case ("box",):
            return [geometry.box()]
        case ("plane",):
            return [geometry.square()]
        case ("cylinder",):
            return [geometry.cylinder(segments) for segments in SEGMENTS]
        case ("sphere",):
            return [geometry.capsule(1.0, 0.0, segments) for segments in SEGMENTS]
        case ("capsule", float(radius), float(length)):
            return [geometry.capsule(radius, length, segments) for segments in SEGMENTS]
        case ("mesh", str(name)):
            mesh = scene.meshes[name]
            return [geometry.from_mesh(mesh.positions, mesh.normals, mesh.indices)]
    raise ValueError(f"there is no shape {key}")


def _scale(shape: Shape) -> tuple[float, float, float]:
    size = shape.size
    match shape.shape:
        case "cylinder":
            return size[0], size[0], size[1]
        case "sphere":
            return size[0], size[0], size[0]
        case "plane":
            return size[0], size[1], 1.0
        case "capsule":
            return 1.0, 1.0, 1.0
        case _:
            return size[0], size[1], size[2]
