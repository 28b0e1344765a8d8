"""Geometry of areas, against numbers by hand and against each other."""

import math

import numpy as np
import pytest

from executor.evaluation.areas import contains, distance_m, draw_in

SQUARE = ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))
HOOK = ((0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0))


def test_inside_and_outside():
    assert contains(SQUARE, 1, 1)
    assert not contains(SQUARE, 3, 1)
    assert contains(HOOK, 0.5, 2.5)
    assert not contains(HOOK, 2, 2)
    assert contains(tuple(reversed(HOOK)), 2, 0.5)


def test_distances():
    assert distance_m(SQUARE, 1, 1) == 0
    assert distance_m(SQUARE, 4, 1) == pytest.approx(2)
    assert distance_m(SQUARE, 3, 3) == pytest.approx(math.sqrt(2))
    assert distance_m(HOOK, 2, 2) == pytest.approx(1)


def test_points_are_spread_over_the_area():
    generator = np.random.default_rng(1)
    points = [draw_in(HOOK, generator) for _ in range(2000)]
    assert all(contains(HOOK, *point) for point in points)
    share = sum(x < 1 for x, _ in points) / len(points)  # the upright part is three fifths of the hook
    assert share == pytest.approx(0.6, abs=0.05)


def test_a_thin_area_is_an_error_not_a_loop():
    needle = ((0.0, 0.0), (1000.0, 1000.0), (1000.0, 1000.0000001))
    with pytest.raises(ValueError, match="too thin"):
        draw_in(needle, np.random.default_rng(1))
