"""An occupancy grid, and the distance from each of its cells to the next obstacle.

Cells are indexed [row, column]: rows go along y, columns along x. Lengths are in m.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

Cell = tuple[int, int]

FAR: Final = 1e9


@dataclass(frozen=True)
class Grid:
    """Which cells are occupied. `origin` is the lower left corner of the first cell."""

    occupied: NDArray[np.bool_]
    resolution: float
    origin: tuple[float, float]

    @classmethod
    def empty(cls, low: tuple[float, float], high: tuple[float, float], resolution: float) -> Grid:
        """Returns a free grid that covers a rectangle."""
        columns = max(1, math.ceil((high[0] - low[0]) / resolution))
        rows = max(1, math.ceil((high[1] - low[1]) / resolution))
        return cls(np.zeros((rows, columns), np.bool_), resolution, low)

    def cell(self, x: float, y: float) -> Cell | None:
        """Returns the cell of a point; None outside of the grid."""
        column = math.floor((x - self.origin[0]) / self.resolution)
        row = math.floor((y - self.origin[1]) / self.resolution)
        rows, columns = self.occupied.shape
        return (row, column) if 0 <= row < rows and 0 <= column < columns else None

    def point(self, cell: Cell) -> tuple[float, float]:
        """Returns the centre of a cell."""
        row, column = cell
        return (
            self.origin[0] + (column + 0.5) * self.resolution,
            self.origin[1] + (row + 0.5) * self.resolution,
        )

    def clearance(self, most: float = math.inf) -> NDArray[np.float64]:
        """Returns the distance in m from the centre of each cell to that of the next occupied cell.

        Larger distances than `most` are given as `most`, which saves time.
        """
        shifts = int(min(most / self.resolution + 1, max(self.occupied.shape)))
        squares = np.where(self.occupied, 0.0, FAR)
        squares = _along_columns(squares, shifts)
        squares = _along_columns(squares.T, shifts).T
        return np.minimum(np.sqrt(squares) * self.resolution, most)


def _along_columns(squares: NDArray[np.float64], shifts: int) -> NDArray[np.float64]:
    """Returns the least of `squares` plus the squared distance along each column.

    One shift after the other; it ends when a further shift cannot make any cell nearer.
    """
    best = squares.copy()
    rows = len(squares)
    finite = best[best < FAR]
    if not finite.size:
        return best
    for shift in range(1, min(rows, shifts + 1)):
        square = float(shift * shift)
        if square >= best.max():
            break
        np.minimum(best[shift:], squares[:-shift] + square, out=best[shift:])
        np.minimum(best[:-shift], squares[shift:] + square, out=best[:-shift])
    return best
