"""Boxes of pixels that cover all changes."""

from __future__ import annotations

import numpy as np

from executor.render.rectangles import merged


def test_boxes_that_overlap_become_one() -> None:
    boxes = np.array([[0, 0, 10, 10], [5, 5, 20, 8], [100, 100, 110, 120]])
    assert sorted(merged(boxes)) == [(0, 0, 20, 10), (100, 100, 10, 20)]


def test_there_are_never_more_than_asked_for() -> None:
    boxes = np.array([[n * 100, 0, n * 100 + 10, 10] for n in range(50)])
    found = merged(boxes, 5)
    assert len(found) == 5
    assert all(any(x <= left and left + 10 <= x + w for x, _, w, _ in found) for left, *_ in boxes.tolist())
