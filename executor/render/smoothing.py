"""Smooths the edges of a finished picture, where the renderer is a CPU.

Morphological antialiasing (Reshetov, 2009): a staircase in the picture is a straight edge that was sampled
once a pixel. Runs of edge pixels and the steps at their ends tell where that edge was, and so how much of
each pixel it covers. The work is proportional to the edges, not to the pixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import cv2
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Indices = NDArray[np.intp]

CONTRAST: Final = 12
LEAST_SHARE: Final = 0.04


def smoothed(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Smooths an RGB picture in place, and returns it."""
    height, width = picture.shape[:2]
    gray = cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY)
    # Edges below a pixel, and to its right. None at the rim, so that looking beyond it finds nothing.
    below, beside = np.zeros((height, width), bool), np.zeros((height, width), bool)
    np.greater(cv2.absdiff(gray[:-1], gray[1:]), CONTRAST, out=below[:-1])
    np.greater(cv2.absdiff(gray[:, :-1], gray[:, 1:]), CONTRAST, out=beside[:, :-1])
    pixels = _Pixels(picture.reshape(-1, 3), np.asarray(gray, np.uint8).reshape(-1))

    rows = np.flatnonzero(below)
    new_line = (np.diff(rows, prepend=-2) != 1) | (rows % width == 0)
    pixels.smooth(rows, new_line, beside.reshape(-1), along=1, across=width)

    columns = np.flatnonzero(cv2.transpose(beside.view(np.uint8)).reshape(-1))
    new_line = (np.diff(columns, prepend=-2) != 1) | (columns % height == 0)
    x, y = np.divmod(columns, height)
    pixels.smooth(y * width + x, new_line, below.reshape(-1), along=width, across=1)
    return picture


@dataclass(frozen=True)
class _Pixels:
    """A picture, row by row: colours, and how bright they were before anything was smoothed."""

    colors: NDArray[np.uint8]
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
            new_line: where an edge does not go on the one before.
            steps: edges between a pixel and the pixel `along` further.
            along: from a pixel to the next one in a run.
            across: from a pixel to the one at the other side of its edge.
        """
        if not len(edges):
            return
        is_darker = self.brightness.take(edges) < self.brightness.take(edges + across)
        new_line[1:] |= is_darker[1:] != is_darker[:-1]
        starts = np.flatnonzero(new_line)
        lengths = np.diff(starts, append=len(edges))
        first, last = edges[starts], edges[starts + lengths - 1]
        # +1: the run steps to this side there, -1: to the other side, 0: it does not, or both.
        at_start = steps[first - along].astype(np.int8) - steps[first - along + across]
        at_end = steps[last].astype(np.int8) - steps[np.minimum(last + across, len(steps) - 1)]
        bent = (lengths > 1) & ((at_start != 0) | (at_end != 0))
        starts, lengths, at_start, at_end = starts[bent], lengths[bent], at_start[bent], at_end[bent]
        if not len(starts):
            return
        ends = np.cumsum(lengths)
        place = np.arange(ends[-1]) - np.repeat(ends - lengths, lengths)
        pixels = edges[np.repeat(starts, lengths) + place]
        way = (2 * place + 1).astype(np.float32) / np.repeat(lengths, lengths)
        rise = np.where(way < 1, np.repeat(at_start, lengths), np.repeat(at_end, lengths)) * np.abs(1 - way)
        share = np.abs(rise) * np.float32(0.5)
        told = share > LEAST_SHARE
        pixels, share, is_here = pixels[told], share[told, None], rise[told] > 0
        mixed, other = np.where(is_here, pixels, pixels + across), np.where(is_here, pixels + across, pixels)
        own = self.colors.take(mixed, axis=0).astype(np.float32)
        own += (self.colors.take(other, axis=0) - own) * share
        self.colors[mixed] = (own + 0.5).astype(np.uint8)
