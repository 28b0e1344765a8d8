"""The shadow map of the GL renderer: redrawn only where something moved."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from executor.render.rectangles import merged

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.render.interface import Viewpoint
    from executor.render.pieces import Floats, Order, Pieces
    from executor.render.rectangles import Rectangle

SIZE: Final = 2048
LARGEST_REACH_M: Final = 24.0
CELL_M: Final = 8.0
ROOM_M: Final = 1.5
MOVED: Final = 1e-4
LEVELS_TEXELS: Final = (10.0, 25.0, 60.0)
SMALLEST_TEXELS: Final = 0.7


class ShadowPlan:
    """Computes the camera of the light, and the parts of its map to redraw. It draws nothing itself.

    A scene up to twice `LARGEST_REACH_M` wide is covered completely; in a wider one the map follows the
    viewer in steps of `CELL_M`.
    """

    def __init__(self, pieces: Pieces, placed: Floats, sun: NDArray[np.float64]) -> None:
        self._pieces = pieces
        self.sun = sun
        self._turn = _light_axes(sun)
        self._asked: Floats | None = None
        self._drawn: Floats = placed.copy()
        self._texels: Floats | None = None
        self._follows = False
        self._center = self._middle = np.zeros(3)
        self.matrix = np.eye(4)
        self._fit(placed)

    @property
    def texel_m(self) -> float:
        """The width of a texel in m."""
        return 2 * self.reach_m / SIZE

    def dirty(self, placed: Floats, view: Viewpoint) -> list[tuple[Rectangle, Order]]:
        """Returns the parts to redraw in texels [x, y, width, height], and counts them as drawn."""
        center = self._look_at(view)
        if not np.array_equal(center, self._center):
            self._center, self._texels = center, None
        if self._texels is not None and placed is self._asked:
            return []
        self._asked = placed
        changed = np.abs(placed - self._drawn).max(axis=(1, 2), initial=0.0) > MOVED
        self._drawn[changed] = placed[changed]
        if self._texels is None:
            return self._everything()
        moved = changed[self._pieces.rows]
        if not moved.any():
            return []
        old, self._texels = self._texels, self._measure()
        if not self._follows and _are_outside(self._texels[moved]):
            self._fit(self._drawn)
            return self._everything()
        rectangles = merged(_boxes(np.concatenate([old[moved], self._texels[moved]])))
        return [self._work(rectangle, self._texels) for rectangle in rectangles]

    def _fit(self, placed: Floats) -> None:
        """Fits the shadow map to the scene, with a margin for motion."""
        low, high = self._bounds(placed)
        half = (high - low) / 2 + ROOM_M
        self._middle = self._center = (low + high) / 2
        self._follows = bool(half[:2].max() > LARGEST_REACH_M)
        self.reach_m = float(min(half[:2].max(), LARGEST_REACH_M))
        self._deep = float(half[2]) + self.reach_m

    def _everything(self) -> list[tuple[Rectangle, Order]]:
        self.matrix = self._matrix(self._center)
        self._texels = self._measure()
        return [self._work((0, 0, SIZE, SIZE), self._texels)]

    def _bounds(self, placed: Floats) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Returns the lowest and highest corner of all pieces along the light's axes."""
        corners: NDArray[np.float64] = self._pieces.corners(placed) @ self._turn.T
        if not len(corners):
            return np.full(3, -1.0), np.full(3, 1.0)
        return corners.min(axis=0), corners.max(axis=0)

    def _look_at(self, view: Viewpoint) -> NDArray[np.float64]:
        if not self._follows:
            return self._middle
        ahead = np.array(view.eye) + np.array(view.ahead) * self.reach_m * 0.6
        center: NDArray[np.float64] = self._turn @ (np.round(ahead / CELL_M) * CELL_M)
        center[2] = self._middle[2]
        return center

    def _matrix(self, center: NDArray[np.float64]) -> NDArray[np.float64]:
        """Returns the transform from the world to the shadow map: x, y and depth from 0 to 1."""
        matrix = np.eye(4)
        matrix[:3, :3] = self._turn
        matrix[:3, 3] = -center
        scale = np.diag([0.5 / self.reach_m, 0.5 / self.reach_m, -0.5 / self._deep, 1.0])
        scale[:3, 3] = 0.5
        return scale @ matrix

    def _measure(self) -> Floats:
        """Returns [x, y, radius] of each piece in texels."""
        at = self._pieces.centers(self._drawn) @ self.matrix[:2, :3].T.astype(np.float32)
        at += self.matrix[:2, 3].astype(np.float32)
        return np.column_stack([at, self._pieces.radii * (0.5 / self.reach_m)]).astype(np.float32) * SIZE

    def _work(self, rectangle: Rectangle, texels: Floats) -> tuple[Rectangle, Order]:
        x, y, wide, high = rectangle
        radii = texels[:, 2]
        rounds = self._pieces.rounds * (0.5 * SIZE / self.reach_m)
        shown = (radii > SMALLEST_TEXELS) & ~self._pieces.is_flat & ~self._pieces.is_ceiling
        for at, first, length in ((texels[:, 0], x, wide), (texels[:, 1], y, high)):
            shown &= (at + radii >= first) & (at - radii <= first + length)
        numbers = np.flatnonzero(shown)
        levels = len(LEVELS_TEXELS) - np.searchsorted(LEVELS_TEXELS, rounds[numbers])
        return rectangle, self._pieces.order_of(numbers, levels)


def _light_axes(sun: NDArray[np.float64]) -> NDArray[np.float64]:
    side = np.cross(sun, [0.0, 0.0, 1.0])
    if np.linalg.norm(side) < 1e-6:
        side = np.array([1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    return np.array([side, np.cross(side, sun), -sun])


def _are_outside(texels: Floats) -> bool:
    return bool(((texels[:, :2] < texels[:, 2:]) | (texels[:, :2] > SIZE - texels[:, 2:])).any())


def _boxes(texels: Floats) -> NDArray[np.int64]:
    """Returns [left, bottom, right, top] of each row, enlarged by a texel."""
    low = np.floor(texels[:, :2] - texels[:, 2:] - 1)
    high = np.ceil(texels[:, :2] + texels[:, 2:] + 1)
    boxes: NDArray[np.int64] = np.clip(np.column_stack([low, high]), 0, SIZE).astype(np.int64)
    return boxes[(boxes[:, 2] > boxes[:, 0]) & (boxes[:, 3] > boxes[:, 1])]
