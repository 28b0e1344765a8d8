"""Geometry of areas: polygons of the floor, in m."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

    Point = tuple[float, float]
    Corners = Sequence[tuple[float, float]]

MOST_DRAWS: Final = 10_000


def contains(corners: Corners, x: float, y: float) -> bool:
    """Returns whether a point lies in a polygon, by the even-odd rule."""
    inside = False
    x0, y0 = corners[-1]
    for x1, y1 in corners:
        if (y1 > y) != (y0 > y) and x < (x0 - x1) * (y - y1) / (y0 - y1) + x1:
            inside = not inside
        x0, y0 = x1, y1
    return inside


def distance_m(corners: Corners, x: float, y: float) -> float:
    """Returns the distance of a point from a polygon; 0 inside."""
    if contains(corners, x, y):
        return 0.0
    return min(
        _to_edge((x, y), start, end) for start, end in zip(corners, (*corners[1:], corners[0]), strict=True)
    )


def draw_in(corners: Corners, generator: np.random.Generator) -> tuple[float, float]:
    """Returns a point of a polygon, uniformly distributed over it.

    Raises:
        ValueError: the polygon is so thin that no point of it was found.
    """
    xs, ys = [x for x, _ in corners], [y for _, y in corners]
    for _ in range(MOST_DRAWS):
        x, y = float(generator.uniform(min(xs), max(xs))), float(generator.uniform(min(ys), max(ys)))
        if contains(corners, x, y):
            return x, y
    raise ValueError("the area is too thin")


def _to_edge(point: Point, start: Point, end: Point) -> float:
    (x, y), (x0, y0), (x1, y1) = point, start, end
    along, across = x1 - x0, y1 - y0
    length = along * along + across * across
    share = 0.0 if length == 0 else ((x - x0) * along + (y - y0) * across) / length
    share = min(1.0, max(0.0, share))
    return math.hypot(x - x0 - share * along, y - y0 - share * across)
