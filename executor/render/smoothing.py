"""Smooths the edges of a finished picture, for software rendering.

Morphological antialiasing (Reshetov, 2009): a staircase in the picture is a straight edge that was sampled
once for each pixel. Runs of edge pixels and the steps at their ends determine the straight edge, and thus the
share of each pixel that it covers. The work is proportional to the edges, not to the pixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

import cv2
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Indices = NDArray[np.intp]

CONTRAST: Final = 12
LEAST_WEIGHT: Final = 11
"""Smallest weight that is mixed, in 256ths; a smaller share of a neighbour is invisible."""
_EVEN: Final = np.uint32(0x00FF00FF)
_ODD: Final = np.uint32(0xFF00FF00)
_HALF: Final = np.uint32(0x00800080)
_EIGHT: Final = np.uint32(8)


def smoothed(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Smooths an RGBA picture in place, and returns it."""
    height, width = picture.shape[:2]
    gray = cv2.cvtColor(picture, cv2.COLOR_RGBA2GRAY)
    # Edges below a pixel, and to its right. The border has none, so that no index leaves the picture.
    below, beside = np.zeros((height, width), bool), np.zeros((height, width), bool)
    np.greater(cv2.absdiff(gray[:-1], gray[1:]), CONTRAST, out=below[:-1])
    np.greater(cv2.absdiff(gray[:, :-1], gray[:, 1:]), CONTRAST, out=beside[:, :-1])
    pixels = _Pixels(picture.reshape(-1).view(np.uint32), np.asarray(gray, np.uint8).reshape(-1))

    rows = np.flatnonzero(below)
    pixels.smooth(rows, _new_lines(rows, width), beside.reshape(-1), along=1, across=width)

    columns = np.flatnonzero(cv2.transpose(beside.view(np.uint8)).view(bool))
    x, y = np.divmod(columns, height)
    new_line = _new_lines(columns, height)
    pixels.smooth(y * width + x, new_line, below.reshape(-1), along=width, across=1)
    return picture


def _new_lines(edges: Indices, length: int) -> NDArray[np.bool_]:
    """Returns whether each edge begins a new run: it does not continue the edge before it."""
    new = np.ones(len(edges), bool)
    np.not_equal(edges[1:] - edges[:-1], 1, out=new[1:])
    new |= edges % length == 0
    return new


@dataclass(frozen=True)
class _Pixels:
    """A picture, row by row: colours of four bytes, and their brightness before smoothing."""

    colors: NDArray[np.uint32]
    brightness: NDArray[np.uint8]

    def smooth(
        self,
        edges: Indices,
        new_line: NDArray[np.bool_],
        steps: NDArray[np.bool_],
        *,
        along: int,
        across: int,
    ) -> None:
        """Mixes pixels on both sides of the runs of edges.

        Args:
            edges: pixels with an edge between them and the pixel `across` further, run by run.
            new_line: whether each edge does not continue the one before it.
            steps: edges between a pixel and the pixel `along` further.
            along: the offset from a pixel to the next one in a run.
            across: the offset from a pixel to the one on the other side of its edge.
        """
        if not len(edges):
            return
        is_darker = self.brightness.take(edges) < self.brightness.take(edges + across)
        new_line[1:] |= is_darker[1:] != is_darker[:-1]
        starts = np.flatnonzero(new_line)
        lengths = np.diff(starts, append=len(edges))
        starts, lengths = _picked(lengths > 1, starts, lengths)
        first, last = edges.take(starts), edges.take(starts + lengths - 1)
        # +1: the run steps to this side at that end; -1: to the other side; 0: it does not step, or to both.
        step = steps.view(np.int8)
        at_start = step.take(first - along) - step.take(first - along + across)
        at_end = step.take(last) - step.take(last + across, mode="clip")
        starts, lengths, at_start, at_end = _picked(
            (at_start | at_end) != 0, starts, lengths, at_start, at_end
        )
        if not len(starts):
            return
        run = np.repeat(np.arange(len(starts)), lengths)
        place = np.arange(len(run)) - (np.cumsum(lengths) - lengths).take(run)
        length = lengths.take(run)
        # The weight of the neighbour grows from 0 in the middle of a run to one half at its ends.
        off = length - 2 * place - 1
        side = np.where(off > 0, at_start.take(run), at_end.take(run))
        weight = np.abs(off) * 128 // length
        pixels = starts.take(run) + place
        pixels, side, weight = _picked((side != 0) & (weight >= LEAST_WEIGHT), pixels, side, weight)
        here = edges.take(pixels)
        there = here + across
        is_here = side > 0
        self._mix(np.where(is_here, here, there), np.where(is_here, there, here), weight.astype(np.uint32))

    def _mix(self, pixels: Indices, others: Indices, weight: NDArray[np.uint32]) -> None:
        """Mixes other pixels into pixels, with weights in 256ths.

        Processes two bytes of a colour in one step.
        """
        own, other, rest = self.colors.take(pixels), self.colors.take(others), np.uint32(256) - weight
        even = ((own & _EVEN) * rest + (other & _EVEN) * weight + _HALF) >> _EIGHT
        odd = ((own >> _EIGHT) & _EVEN) * rest + ((other >> _EIGHT) & _EVEN) * weight + _HALF
        self.colors[pixels] = (even & _EVEN) | (odd & _ODD)


def _picked(which: NDArray[np.bool_], *columns: NDArray[Any]) -> list[NDArray[Any]]:
    rows = np.flatnonzero(which)
    return [column.take(rows) for column in columns]
