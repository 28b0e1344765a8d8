"""A* on an inflated grid, in slices: a long search never holds up the world."""

from __future__ import annotations

import heapq
import math
from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from executor.navigation.grid import Cell, Grid

_STEPS: Final = [
    (row, column, math.hypot(row, column)) for row in (-1, 0, 1) for column in (-1, 0, 1) if row or column
]
INFLATION_M: Final = 0.35
"""The width of the zone beside the robot's radius that costs more, so that paths keep away from walls."""
FREE_M: Final = 1.0
"""Beyond this distance from the robot's body it does not matter how far an obstacle is."""
OCCUPIED: Final = 254.0
INSCRIBED: Final = 253.0
"""Nav2's costs of a cell that is occupied, and of one that is too near for the robot."""
MOST_COST: Final = 6.0
"""How many times as much a cell costs that just lets the robot through."""


class Map:
    """A grid for a round robot: the cells that it may enter, and the cost of each cell."""

    def __init__(self, grid: Grid, radius: float) -> None:
        self.grid = grid
        self.radius = radius
        self.clearance = grid.clearance(radius + FREE_M)
        self.is_free = self.clearance > radius
        near = np.clip((radius + INFLATION_M - self.clearance) / INFLATION_M, 0.0, 1.0)
        self.cost = 1.0 + (MOST_COST - 1.0) * near**2

    def allows(self, x: float, y: float) -> bool:
        """Returns whether the robot may stand at a point."""
        cell = self.grid.cell(x, y)
        return cell is not None and bool(self.is_free[cell])

    def clearance_at(self, x: float, y: float) -> float:
        """Returns the distance to the next obstacle; 0 outside of the map."""
        cell = self.grid.cell(x, y)
        return float(self.clearance[cell]) if cell is not None else 0.0

    def nav2_cost(self, x: float, y: float, *, is_footprint: bool) -> float:
        """Returns the cost of a point as Nav2's costmap has it.

        254 is occupied, 253 is nearer to it than the robot's radius, and further away the cost falls to 0. It
        is -1 outside of the map.

        Args:
            x: in m, in the map.
            y: in m, in the map.
            is_footprint: whether the robot's circle there counts, which is occupied if any of it is.
        """
        cell = self.grid.cell(x, y)
        if cell is None:
            return -1.0
        if self.grid.occupied[cell]:
            return OCCUPIED
        if not self.is_free[cell]:
            return OCCUPIED if is_footprint else INSCRIBED
        return float(round((INSCRIBED - 1) * (self.cost[cell] - 1.0) / (MOST_COST - 1.0)))

    def nearest_free(self, cell: Cell, within_m: float) -> Cell | None:
        """Returns the free cell that is nearest to a cell; None if none is as near as `within_m`."""
        rows, columns = np.nonzero(self.is_free)
        if not len(rows):
            return None
        squares = (rows - cell[0]) ** 2 + (columns - cell[1]) ** 2
        best = int(np.argmin(squares))
        if math.sqrt(float(squares[best])) * self.grid.resolution > within_m:
            return None
        return int(rows[best]), int(columns[best])


class Search:
    """A search for the cheapest path between two free cells; `expand` continues it."""

    def __init__(self, space: Map, start: Cell, goal: Cell) -> None:
        self._space = space
        self._start, self._goal = start, goal
        self._best: dict[Cell, float] = {start: 0.0}
        self._from: dict[Cell, Cell] = {}
        self._closed: set[Cell] = set()
        self._open: list[tuple[float, Cell]] = [(self._left(start), start)]
        self.is_over = False
        self.path: list[Cell] | None = None
        """The cells from start to goal once the search is over; None if no path exists."""
        self.cost = math.inf

    def expand(self, count: int) -> bool:
        """Expands at most `count` cells; returns whether the search is over."""
        for _ in range(count):
            if self.is_over:
                break
            if not self._open:
                self.is_over = True
                break
            self._expand_one()
        return self.is_over

    def _expand_one(self) -> None:
        _, cell = heapq.heappop(self._open)
        if cell in self._closed:
            return
        self._closed.add(cell)
        if cell == self._goal:
            self.is_over, self.path, self.cost = True, self._trace(), self._best[cell]
            return
        free, cost = self._space.is_free, self._space.cost
        rows, columns = free.shape
        so_far = self._best[cell]
        for row, column, length in _STEPS:
            other = (cell[0] + row, cell[1] + column)
            if not (0 <= other[0] < rows and 0 <= other[1] < columns) or not free[other]:
                continue
            # A diagonal step between two blocked cells would cut their corners.
            if row and column and not (free[cell[0] + row, cell[1]] and free[cell[0], cell[1] + column]):
                continue
            total = so_far + length * float(cost[other])
            if total < self._best.get(other, math.inf):
                self._best[other] = total
                self._from[other] = cell
                heapq.heappush(self._open, (total + self._left(other), other))

    def _left(self, cell: Cell) -> float:
        """Returns a lower bound of the cost to the goal: a cell costs at least 1."""
        rows, columns = abs(cell[0] - self._goal[0]), abs(cell[1] - self._goal[1])
        return max(rows, columns) + (math.sqrt(2) - 1) * min(rows, columns)

    def _trace(self) -> list[Cell]:
        path = [self._goal]
        while path[-1] != self._start:
            path.append(self._from[path[-1]])
        return path[::-1]


def smoothed(points: list[tuple[float, float]], space: Map, passes: int = 20) -> list[tuple[float, float]]:
    """Returns the path with its corners rounded; a point that would leave the free space stays."""
    smooth = list(points)
    for _ in range(passes):
        for i in range(1, len(smooth) - 1):
            (ax, ay), (bx, by), (cx, cy) = smooth[i - 1 : i + 2]
            x, y = (ax + 2 * bx + cx) / 4, (ay + 2 * by + cy) / 4
            if space.allows(x, y):
                smooth[i] = (x, y)
    return smooth
