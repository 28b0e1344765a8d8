"""Intervals and tests for rates, and comparisons of pairs. Pure; each says where its formula comes from."""

from __future__ import annotations

import math
from statistics import NormalDist
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

BOOTSTRAP_DRAWS: Final = 10_000
BOOTSTRAP_SEED: Final = 0
_HALVINGS: Final = 80
_TERMS: Final = 500
_TINY: Final = 1e-300


class Interval(NamedTuple):
    """An interval of a rate or of a difference."""

    low: float
    high: float

    @property
    def half_width(self) -> float:
        """Half of its length."""
        return (self.high - self.low) / 2


class Difference(NamedTuple):
    """A difference with its interval."""

    value: float
    low: float
    high: float


def wilson(successes: int, runs: int, confidence: float = 0.95) -> Interval:
    """Returns Wilson's score interval of a rate (Wilson 1927, J. Am. Stat. Assoc. 22:209)."""
    if runs == 0:
        return Interval(0.0, 1.0)
    z = NormalDist().inv_cdf((1 + confidence) / 2)
    rate, share = successes / runs, z * z / runs
    middle = (rate + share / 2) / (1 + share)
    half = z / (1 + share) * math.sqrt(rate * (1 - rate) / runs + share / (4 * runs))
    low = 0.0 if successes == 0 else max(0.0, middle - half)
    high = 1.0 if successes == runs else min(1.0, middle + half)
    return Interval(low, high)


def clopper_pearson(successes: int, runs: int, confidence: float = 0.95) -> Interval:
    """Returns the exact interval of a rate (Clopper and Pearson 1934, Biometrika 26:404)."""
    tail = (1 - confidence) / 2
    return Interval(lower_bound(successes, runs, 1 - tail), upper_bound(successes, runs, 1 - tail))


def lower_bound(successes: int, runs: int, confidence: float = 0.95) -> float:
    """Returns the exact one-sided lower bound of a rate."""
    if successes == 0:
        return 0.0
    return _inverse(lambda p: beta_share(successes, runs - successes + 1, p), 1 - confidence)


def upper_bound(successes: int, runs: int, confidence: float = 0.95) -> float:
    """Returns the exact one-sided upper bound of a rate."""
    if successes == runs:
        return 1.0
    return _inverse(lambda p: beta_share(successes + 1, runs - successes, p), confidence)


def confidence_sequence(successes: int, runs: int, confidence: float = 0.95) -> Interval:
    """Returns an interval of a rate that is valid after every run, so that the evaluation may stop after any.

    It holds every rate p whose beta-binomial mixture martingale with the prior (1/2, 1/2),
    B(s + 1/2, f + 1/2) / (B(1/2, 1/2) · p^s · (1 - p)^f), is below 1 / (1 - confidence) (Robbins 1970,
    Ann. Math. Stat. 41:1397; by Ville's inequality).
    """
    if runs == 0:
        return Interval(0.0, 1.0)
    failures, limit = runs - successes, -math.log(1 - confidence)
    fixed = _log_beta(successes + 0.5, failures + 0.5) - _log_beta(0.5, 0.5)

    def is_outside(p: float) -> bool:
        return fixed - _times_log(successes, p) - _times_log(failures, 1 - p) >= limit

    rate = successes / runs
    return Interval(_edge(is_outside, 0.0, rate), _edge(is_outside, 1.0, rate))


def mcnemar(only_first: int, only_second: int) -> float:
    """Returns the p-value of McNemar's exact two-sided test on the pairs that differ."""
    fewer, both = min(only_first, only_second), only_first + only_second
    return min(1.0, 2 * binomial_up_to(fewer, both))


def mcnemar_worse(only_older: int, only_newer: int) -> float:
    """Returns the p-value of McNemar's exact one-sided test of whether the newer version is worse.

    Args:
        only_older: pairs in which only the older version succeeded.
        only_newer: pairs in which only the newer one did.
    """
    return binomial_up_to(only_newer, only_older + only_newer)


def newcombe_paired(
    both: int, only_first: int, only_second: int, neither: int, confidence: float = 0.95
) -> Difference:
    """Returns the difference of two rates on the same pairs, first minus second, with its interval.

    Newcombe 1998, Statistics in Medicine 17:2635, method 10: Wilson's intervals squared and added, with the
    correlation of the pairs.
    """
    runs = both + only_first + only_second + neither
    if runs == 0:
        return Difference(0.0, -1.0, 1.0)
    first, second = both + only_first, both + only_second
    (low1, high1), (low2, high2) = wilson(first, runs, confidence), wilson(second, runs, confidence)
    rate1, rate2 = first / runs, second / runs
    phi = _correlation(both, only_first, only_second, neither)

    def added(a: float, b: float) -> float:
        return math.sqrt(max(0.0, a * a - 2 * phi * a * b + b * b))

    value = (only_first - only_second) / runs
    return Difference(
        value, value - added(rate1 - low1, high2 - rate2), value + added(high1 - rate1, rate2 - low2)
    )


def newcombe(first: int, first_runs: int, second: int, second_runs: int) -> Difference:
    """Returns the difference of two independent rates, first minus second, with its 95 % interval.

    Newcombe 1998, Statistics in Medicine 17:873, method 10: Wilson's intervals squared and added.
    """
    if first_runs == 0 or second_runs == 0:
        return Difference(0.0, -1.0, 1.0)
    (low1, high1), (low2, high2) = wilson(first, first_runs), wilson(second, second_runs)
    rate1, rate2 = first / first_runs, second / second_runs
    value = rate1 - rate2
    return Difference(
        value,
        value - math.hypot(rate1 - low1, high2 - rate2),
        value + math.hypot(high1 - rate1, rate2 - low2),
    )


def bootstrap_paired(differences: Sequence[float], confidence: float = 0.95) -> Difference:
    """Returns the mean of paired differences with its percentile interval, from 10,000 draws of a fixed seed.

    Raises:
        ValueError: there are no differences.
    """
    if not differences:
        raise ValueError("there are no pairs to compare")
    values = np.asarray(differences, np.float64)
    generator = np.random.Generator(np.random.PCG64(BOOTSTRAP_SEED))
    means = np.array(
        [values[generator.integers(len(values), size=len(values))].mean() for _ in range(BOOTSTRAP_DRAWS)]
    )
    low, high = np.quantile(means, [(1 - confidence) / 2, (1 + confidence) / 2])
    return Difference(float(values.mean()), float(low), float(high))


def quantile(values: Sequence[float], share: float) -> float:
    """Returns the smallest value that at least a share of all values do not exceed.

    Raises:
        ValueError: there are no values.
    """
    if not values:
        raise ValueError("there are no values")
    ordered = sorted(values)
    return ordered[max(0, math.ceil(share * len(ordered) - 1e-9) - 1)]


def fewest_runs(rate: float, confidence: float = 0.95) -> int:
    """Returns the fewest runs with which a lower bound can reach a rate, all of them successes."""
    return max(1, math.ceil(math.log(1 - confidence) / math.log(rate) - 1e-9)) if 0 < rate < 1 else 1


def binomial_up_to(count: int, runs: int) -> float:
    """Returns the probability of at most `count` heads in `runs` throws of a fair coin."""
    return 1.0 if count >= runs else beta_share(runs - count, count + 1, 0.5)


def beta_share(a: float, b: float, x: float) -> float:
    """Returns the regularised incomplete beta function, by its continued fraction (DLMF 8.17.22)."""
    if x <= 0 or x >= 1:
        return 0.0 if x <= 0 else 1.0
    if x > (a + 1) / (a + b + 2):
        return 1.0 - beta_share(b, a, 1 - x)
    front = math.exp(a * math.log(x) + b * math.log1p(-x) - _log_beta(a, b)) / a
    c, d = 1.0, 1.0 / _not_zero(1 - (a + b) * x / (a + 1))
    fraction = d
    for m in range(1, _TERMS):
        for term in (
            m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m)),
            -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1)),
        ):
            d = 1.0 / _not_zero(1 + term * d)
            c = _not_zero(1 + term / c)
            fraction *= c * d
        if abs(c * d - 1) < 1e-15:
            break
    return front * fraction


def _not_zero(value: float) -> float:
    return value if abs(value) > _TINY else _TINY


def _log_beta(a: float, b: float) -> float:
    return math.lgamma(a) + math.lgamma(b) - math.lgamma(a + b)


def _times_log(count: int, p: float) -> float:
    return count * math.log(p) if count and p > 0 else (-math.inf if count else 0.0)


def _inverse(rising: Callable[[float], float], wanted: float) -> float:
    """Returns where a rising function of 0 to 1 has a value."""
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if rising(middle) < wanted else (low, middle)
    return (low + high) / 2


def _edge(is_outside: Callable[[float], bool], outer: float, inner: float) -> float:
    """Returns the last point from `outer` to `inner` that is outside."""
    if not is_outside(outer):
        return outer
    for _ in range(_HALVINGS):
        middle = (outer + inner) / 2
        outer, inner = (middle, inner) if is_outside(middle) else (outer, middle)
    return outer


def _correlation(both: int, only_first: int, only_second: int, neither: int) -> float:
    """Returns the correlation of pairs with the continuity correction of method 10."""
    margins = (both + only_first) * (only_second + neither) * (both + only_second) * (only_first + neither)
    if margins == 0:
        return 0.0
    cross = both * neither - only_first * only_second
    runs = both + only_first + only_second + neither
    if cross > 0:
        cross = max(cross - runs / 2, 0)  # type: ignore[assignment]  # a half
    return cross / math.sqrt(margins)
