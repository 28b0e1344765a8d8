"""The grid's distances against the plain definition, on random grids."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as st_numpy

from executor.navigation.grid import Grid


@given(st_numpy.arrays(np.bool_, st.tuples(st.integers(1, 12), st.integers(1, 12))))
def test_the_clearance_is_the_distance_to_the_next_occupied_cell(occupied: np.ndarray) -> None:
    clearance = Grid(occupied, 0.5, (0.0, 0.0)).clearance()
    places = np.argwhere(occupied)
    for cell, found in np.ndenumerate(clearance):
        if not len(places):
            assert found > 1000
        else:
            assert math.isclose(found, 0.5 * min(math.dist(cell, place) for place in places), abs_tol=1e-9)


@given(st_numpy.arrays(np.bool_, st.tuples(st.integers(1, 12), st.integers(1, 12))), st.floats(0.1, 4.0))
def test_a_limit_changes_only_what_is_beyond_it(occupied: np.ndarray, most: float) -> None:
    grid = Grid(occupied, 0.5, (0.0, 0.0))
    assert np.allclose(grid.clearance(most), np.minimum(grid.clearance(), most))


@given(st.floats(-4.99, 4.99), st.floats(-2.99, 2.99))
def test_a_point_is_in_the_cell_whose_centre_is_near(x: float, y: float) -> None:
    grid = Grid.empty((-5.0, -3.0), (5.0, 3.0), 0.1)
    cell = grid.cell(x, y)
    assert cell is not None
    assert all(abs(a - b) <= 0.05 + 1e-9 for a, b in zip(grid.point(cell), (x, y), strict=True))


def test_a_point_outside_has_no_cell() -> None:
    assert Grid.empty((0, 0), (1, 1), 0.1).cell(-0.01, 0.5) is None
    assert Grid.empty((0, 0), (1, 1), 0.1).cell(0.5, 1.01) is None
