"""The arithmetic of pairs: ratios of two runs, their spread, and whether they show a difference."""

from __future__ import annotations

import dataclasses
import math
import statistics
from typing import TYPE_CHECKING

from tests.benchmarks.figures import Figure, number

if TYPE_CHECKING:
    from collections.abc import Sequence

# All of seven pairs on one side have a probability of 1 in 64 by chance: a figure that did not change is
# reported as a difference so often, and fewer pairs never show one.
CHANCE = 1 / 64


@dataclasses.dataclass(frozen=True)
class Comparison:
    """One figure in all pairs: this tree's value and the other's, in the order of the runs."""

    figure: Figure
    ours: tuple[float, ...]
    others: tuple[float, ...]

    @property
    def ratios(self) -> list[float]:
        """This tree's value by the other's, for each pair."""
        return [ratio(ours, other) for ours, other in zip(self.ours, self.others, strict=True)]

    @property
    def verdict(self) -> str:
        """Whether the pairs show a difference, by the sign test."""
        low, high = (sum(side) for side in zip(*((r < 1, r > 1) for r in self.ratios), strict=True))
        if chance(low, high) > CHANCE:
            return "no difference shown"
        return "better" if (low > high) == (self.figure.better == "lower") else "worse"

    def __str__(self) -> str:
        least, first, middle, third, most = spread(self.ratios)
        ours, others = (number(statistics.median(values)) for values in (self.ours, self.others))
        return (
            f"{self.figure.name[:58]:58} {self.figure.unit:>5} {ours:>9} {others:>9} "
            f"{middle:7.3f}  {first:.3f}…{third:.3f}  {least:.3f}…{most:.3f}  {self.verdict}"
        )


HEAD = f"{'':58} {'unit':>5} {'this tree':>9} {'beside':>9} {'ratio':>7}  {'quartiles':11}  min…max"


def ratio(ours: float, other: float) -> float:
    """Returns ours by the other; two zeros are equal."""
    if other:
        return ours / other
    return 1.0 if not ours else math.inf


def chance(low: int, high: int) -> float:
    """Returns the probability of at least so unequal signs where there is no difference."""
    count, rarer = low + high, min(low, high)
    tail: float = sum(math.comb(count, k) for k in range(rarer + 1)) / 2**count
    return min(1.0, 2 * tail)


def spread(values: Sequence[float]) -> tuple[float, float, float, float, float]:
    """Returns least, first quartile, median, third quartile and greatest."""
    ordered = sorted(values)

    def at(part: float) -> float:
        place = part * (len(ordered) - 1)
        low, high = ordered[math.floor(place)], ordered[math.ceil(place)]
        return low if low == high else low + (high - low) * (place - math.floor(place))

    return at(0), at(0.25), at(0.5), at(0.75), at(1)


def compared(
    pairs: Sequence[tuple[Sequence[Figure], Sequence[Figure]]],
) -> tuple[list[Comparison], list[str]]:
    """Returns the figures that all runs have, and the names of those that some run lacks."""
    runs = [{figure.name: figure for figure in run} for pair in pairs for run in pair]
    first = list(dict.fromkeys(name for run in runs for name in run))
    common = [name for name in first if all(name in run for run in runs)]
    comparisons = [
        Comparison(
            runs[0][name],
            tuple(run[name].value for run in runs[0::2]),
            tuple(run[name].value for run in runs[1::2]),
        )
        for name in common
    ]
    return comparisons, [name for name in first if name not in common]
