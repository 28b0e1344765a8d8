"""Smoothing gives a staircase the slope of its original edge, and changes nothing else."""

import cv2
import numpy as np
from numpy.typing import NDArray

from executor.render.smoothing import smoothed


def half_plane(slope: float, *, finer: int = 1) -> NDArray[np.uint8]:
    """Returns a picture that is white below a line through its middle, drawn `finer` times as large."""
    height, width = 60 * finer, 80 * finer
    y, x = np.mgrid[:height, :width] + 0.5
    white = y - height / 2 > slope * (x - width / 2)
    return np.repeat(np.where(white, 220, 40).astype(np.uint8)[:, :, None], 4, axis=2)


def test_a_slanted_edge_comes_near_to_the_true_one() -> None:
    for slope in (0.07, 0.13, 0.31, -0.22, 3.1, -7.0):
        jagged = half_plane(slope)
        true = cv2.resize(half_plane(slope, finer=8), (80, 60), interpolation=cv2.INTER_AREA).astype(int)
        before = np.abs(jagged.astype(int) - true).sum()
        after = np.abs(smoothed(jagged.copy()).astype(int) - true).sum()
        assert after < 0.45 * before, slope


def test_straight_edges_and_flat_areas_stay_as_they_are() -> None:
    picture = np.full((40, 50, 4), 90, np.uint8)
    picture[10:20, 10:30] = (200, 30, 60, 255)
    assert np.array_equal(smoothed(picture.copy()), picture)
    gradient = np.repeat(np.arange(0, 200, 4, dtype=np.uint8)[None, :, None], 40, axis=0).repeat(4, axis=2)
    assert np.array_equal(smoothed(gradient.copy()), gradient)


def test_edges_at_the_rim_are_borne() -> None:
    noise = np.random.default_rng(3).integers(0, 255, (33, 47, 4), np.uint8)
    assert smoothed(noise.copy()).shape == (33, 47, 4)
    assert smoothed(np.zeros((1, 1, 4), np.uint8)).sum() == 0
