"""Cache of pictures of fixed views: only the parts where something moved are drawn again.

A moving object changes a picture where it was, where it is, and where its shadow was and is. These parts are
redrawn with everything in them, so the result equals a full redraw.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

from executor.render.rectangles import merged
from executor.render.shadow import MOVED

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from executor.render.interface import Viewpoint
    from executor.render.pieces import Floats, Pieces
    from executor.render.rectangles import Rectangle
    from executor.render.shadow import ShadowPlan

    Key = tuple[Viewpoint, int, int]

MOST_KEPT: Final = 2
MOST_RECTANGLES: Final = 8
WORTH_IT: Final = 0.6
"""Share of the picture above which a full redraw is as fast as a partial one."""
BLUR_M: Final = 0.03
"""Margin in m around an object in which its shadow is sampled; two texels of the shadow map are added."""
STEEPEST: Final = -0.1
"""Largest z of the light's direction at which shadows are tracked; those of flatter light are too long."""


@dataclass
class CachedPicture:
    """A picture before and after smoothing, with the poses and the shadow map of that time."""

    raw: NDArray[np.uint8]
    finished: NDArray[np.uint8]
    placed: Floats
    light: NDArray[np.float64]

    def outdated(self, pieces: Pieces, placed: Floats, plan: ShadowPlan, key: Key) -> list[Rectangle] | None:
        """Returns the parts to redraw, and counts them as drawn; None stands for the full picture."""
        if not np.array_equal(self.light, plan.matrix) or plan.sun[2] > STEEPEST:
            return None
        moved = np.abs(placed - self.placed).max(axis=(1, 2), initial=0.0) > MOVED
        numbers = np.flatnonzero(moved[pieces.rows])
        before = self.placed.copy()
        self.placed[moved] = placed[moved]
        if not len(numbers):
            return []
        view, width, height = key
        reached = [_reached(pieces, numbers, where, plan) for where in (before, placed)]
        boxes = _boxes(np.concatenate(reached, axis=1), view, width, height)
        if boxes is None:
            return None
        rectangles = merged(boxes, MOST_RECTANGLES)
        covered = sum(wide * high for _, _, wide, high in rectangles)
        return rectangles if covered < WORTH_IT * width * height else None


class PictureCache:
    """Stores the pictures of the most recently used views."""

    def __init__(self) -> None:
        self._cached: dict[Key, CachedPicture] = {}

    def find(self, key: Key) -> CachedPicture | None:
        """Returns the cached picture of a view in a size, or None."""
        found = self._cached.pop(key, None)
        if found is not None:
            self._cached[key] = found
        return found

    def keep(self, key: Key, picture: CachedPicture) -> None:
        """Stores a picture; the least recently used one is dropped if there are too many."""
        self._cached.pop(key, None)
        while len(self._cached) >= MOST_KEPT:
            del self._cached[next(iter(self._cached))]
        self._cached[key] = picture

    def clear(self) -> None:
        """Drops all pictures, for a new scene."""
        self._cached.clear()


def _reached(
    pieces: Pieces, numbers: NDArray[np.intp], placed: Floats, plan: ShadowPlan
) -> NDArray[np.float64]:
    """Returns points whose hull contains each piece and its shadow: (pieces, points, 3)."""
    margin = BLUR_M + 2 * plan.texel_m
    corners = pieces.corners_of(numbers, placed, margin)
    falls = np.maximum(corners[:, :, 2:], 0.0) / -plan.sun[2]
    return np.concatenate([corners, corners + falls * plan.sun], axis=1)


def _boxes(points: NDArray[np.float64], view: Viewpoint, width: int, height: int) -> NDArray[np.int64] | None:
    """Returns [left, top, right, bottom] in pixels for each row of points.

    None if a point is behind the eye.
    """
    matrix = view.projection_matrix(width, height) @ view.view_matrix()
    clip = points @ matrix[:, :3].T + matrix[:, 3]
    ahead = clip[:, :, 3]
    if (ahead < view.near).any():
        return None
    x = (clip[:, :, 0] / ahead + 1) / 2 * width
    y = (1 - clip[:, :, 1] / ahead) / 2 * height
    lows = np.floor(np.stack([x.min(axis=1), y.min(axis=1)], axis=1)) - 1
    highs = np.ceil(np.stack([x.max(axis=1), y.max(axis=1)], axis=1)) + 1
    size = (width, height)
    boxes = np.concatenate([np.clip(lows, 0, size), np.clip(highs, 0, size)], axis=1).astype(np.int64)
    return boxes[(boxes[:, 2] > boxes[:, 0]) & (boxes[:, 3] > boxes[:, 1])]
