"""Rectangles of pixels [x, y, width, height]: overlapping boxes are merged."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Rectangle = tuple[int, int, int, int]

MOST_RECTANGLES: Final = 24


def merged(boxes: NDArray[np.int64], most: int = MOST_RECTANGLES) -> list[Rectangle]:
    """Returns rectangles that cover all boxes [left, bottom, right, top], and never more than `most`."""
    rectangles: list[list[int]] = []
    for box in boxes[np.argsort(boxes[:, 0], kind="stable")].tolist():
        grown = box
        while True:
            apart = [other for other in rectangles if not _overlap(grown, other)]
            if len(apart) == len(rectangles):
                break
            for other in rectangles:
                if _overlap(grown, other):
                    grown = _union(grown, other)
            rectangles = apart
        rectangles.append(grown)
    while len(rectangles) > most:
        rectangles.append(_union(rectangles.pop(), rectangles.pop()))
    return [(left, low, right - left, top - low) for left, low, right, top in rectangles]


def _overlap(a: list[int], b: list[int]) -> bool:
    return a[0] <= b[2] and b[0] <= a[2] and a[1] <= b[3] and b[1] <= a[3]


def _union(a: list[int], b: list[int]) -> list[int]:
    return [min(a[0], b[0]), min(a[1], b[1]), max(a[2], b[2]), max(a[3], b[3])]
