"""The planner against Dijkstra's plain definition, on random grids."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from executor.navigation.grid import Grid
from executor.navigation.planner import Map, Search, smoothed

Cell = tuple[int, int]


def random_map(seed: int, share: float) -> Map:
    occupied = np.random.default_rng(seed).random((9, 11)) < share
    return Map(Grid(occupied, 0.2, (0.0, 0.0)), 0.1)


def best_cost(space: Map, start: Cell, goal: Cell) -> float:
    """Returns the least cost by relaxing all steps until nothing changes."""
    costs = {start: 0.0}
    rows, columns = space.is_free.shape
    changed = True
    while changed:
        changed = False
        for (row, column), so_far in list(costs.items()):
            for r in (-1, 0, 1):
                for c in (-1, 0, 1):
                    to = (row + r, column + c)
                    if (r, c) == (0, 0) or not (0 <= to[0] < rows and 0 <= to[1] < columns):
                        continue
                    if not space.is_free[to]:
                        continue
                    if r and c and not (space.is_free[row + r, column] and space.is_free[row, column + c]):
                        continue
                    total = so_far + math.hypot(r, c) * float(space.cost[to])
                    if total < costs.get(to, math.inf) - 1e-12:
                        costs[to] = total
                        changed = True
    return costs.get(goal, math.inf)


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 10_000), st.floats(0.0, 0.4), st.integers(1, 20))
def test_the_path_is_free_connected_and_the_cheapest(seed: int, share: float, slice_: int) -> None:
    space = random_map(seed, share)
    free = [(int(r), int(c)) for r, c in np.argwhere(space.is_free)]
    if not free:
        return
    start, goal = free[0], free[-1]
    search = Search(space, start, goal)
    while not search.expand(slice_):
        pass
    best = best_cost(space, start, goal)
    if search.path is None:
        assert best == math.inf
        return
    assert math.isclose(search.cost, best, rel_tol=1e-9, abs_tol=1e-9)
    assert (search.path[0], search.path[-1]) == (start, goal)
    assert all(space.is_free[cell] for cell in search.path)
    for a, b in zip(search.path, search.path[1:], strict=False):
        assert max(abs(a[0] - b[0]), abs(a[1] - b[1])) == 1


def test_the_search_does_no_more_than_its_slice() -> None:
    space = Map(Grid.empty((0, 0), (10, 10), 0.1), 0.1)
    search = Search(space, (0, 0), (99, 99))
    assert not search.expand(10)
    assert len(search._closed) == 10


def test_paths_keep_away_from_walls() -> None:
    grid = Grid.empty((0, 0), (4, 2), 0.1)
    grid.occupied[0, :] = True
    search = Search(Map(grid, 0.1), (3, 2), (3, 37))
    search.expand(100_000)
    assert search.path is not None
    assert max(row for row, _ in search.path) > 4


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 1000))
def test_a_smoothed_path_stays_in_the_free_space_and_keeps_its_ends(seed: int) -> None:
    space = random_map(seed, 0.15)
    free = [(int(r), int(c)) for r, c in np.argwhere(space.is_free)]
    search = Search(space, free[0], free[-1])
    search.expand(10_000)
    if search.path is None:
        return
    points = [space.grid.point(cell) for cell in search.path]
    smooth = smoothed(points, space)
    assert (smooth[0], smooth[-1]) == (points[0], points[-1])
    assert all(space.allows(*point) for point in smooth)


def test_the_nearest_free_cell_is_within_reach_or_none() -> None:
    grid = Grid.empty((0, 0), (2, 2), 0.1)
    grid.occupied[:, :10] = True
    space = Map(grid, 0.15)
    found = space.nearest_free((5, 8), 1.0)
    assert found == (5, 11)
    assert space.nearest_free((5, 0), 0.2) is None


def test_costs_are_those_of_nav2s_costmap() -> None:
    occupied = np.zeros((3, 40), dtype=bool)
    occupied[:, 0] = True
    space = Map(Grid(occupied, 0.1, (0.0, 0.0)), 0.25)

    def cost(x: float, *, is_footprint: bool) -> float:
        return space.nav2_cost(x, 0.15, is_footprint=is_footprint)

    assert [cost(0.05, is_footprint=each) for each in (True, False)] == [254.0, 254.0]
    assert [cost(0.15, is_footprint=each) for each in (True, False)] == [254.0, 253.0]
    falling = [cost(x, is_footprint=True) for x in (0.35, 0.45, 0.55, 0.65, 0.75)]
    assert falling == sorted(falling, reverse=True)
    assert 0 < falling[2] < falling[0] <= 252
    assert cost(3.0, is_footprint=True) == 0.0
    assert cost(9.0, is_footprint=True) == -1.0
