"""Summarises the outcomes of an evaluation: counts, rate with its interval, measures, and the worst runs."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from executor.evaluation.outcome import SUCCESS, Outcome
from executor.evaluation.statistics import (
    Difference,
    Interval,
    bootstrap_paired,
    confidence_sequence,
    mcnemar,
    newcombe,
    newcombe_paired,
    quantile,
    wilson,
)

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from executor.evaluation.document import Until

FIRST_LOOK: Final = 50
LOOK_EVERY: Final = 25
MOST_WORST: Final = 10


@dataclass(frozen=True)
class Summary:
    """The results of an evaluation. `sequential` results were stopped by their own outcomes."""

    outcomes: tuple[Outcome, ...]
    wanted: int
    sequential: bool = False
    stopped_early: bool = False

    @property
    def counts(self) -> dict[str, int]:
        """The number of runs by outcome."""
        return dict(Counter(outcome.outcome for outcome in self.outcomes))

    @property
    def counted(self) -> int:
        """The number of runs that count in the rate."""
        return sum(outcome.is_counted for outcome in self.outcomes)

    @property
    def successes(self) -> int:
        """The number of runs that succeeded."""
        return sum(outcome.is_success for outcome in self.outcomes)

    @property
    def is_complete(self) -> bool:
        """Whether all runs that were wanted have an outcome that counts."""
        return self.counted == self.wanted > 0

    @property
    def rate(self) -> float:
        """The share of successes; 0 without runs."""
        return self.successes / self.counted if self.counted else 0.0

    @property
    def interval(self) -> Interval:
        """The 95 % interval of the rate: Wilson's, or a confidence sequence if outcomes decided the end."""
        return interval_of(self.successes, self.counted, sequential=self.sequential)

    @property
    def measures(self) -> dict[str, list[float]]:
        """The values of each measure, for the runs that count and have it, in the order of the seeds."""
        found: dict[str, list[float]] = {}
        for outcome in self.outcomes:
            if outcome.is_counted:
                for name, value in outcome.measures.items():
                    found.setdefault(name, []).append(value)
        return found

    def worst(self) -> list[Outcome]:
        """Returns the failed runs: exceptions and crashes first, then those that missed by most."""
        failed = [outcome for outcome in self.outcomes if outcome.is_counted and not outcome.is_success]
        return sorted(failed, key=_badness)[:MOST_WORST]

    def lines(self, name: str) -> Iterator[str]:
        """Yields the lines that the terminal shows for the results."""
        low, high = self.interval
        kind = "confidence sequence" if self.sequential else "interval"
        yield (
            f"{name}: success {self.successes} of {self.counted} = {self.rate:.1%}"
            f" (95 % {kind} {low:.1%} to {high:.1%}){', stopped early' if self.stopped_early else ''}"
        )
        others = [
            f"{count} {outcome}" for outcome, count in sorted(self.counts.items()) if outcome != SUCCESS
        ]
        if others:
            yield f"    {', '.join(others)}"
        if not self.is_complete:
            yield f"    incomplete: {self.counted} of {self.wanted} runs count"
        for measure, values in self.measures.items():
            parts = [f"p{share:g} {quantile(values, share / 100):.4g}" for share in (5, 50, 95)]
            yield f"    {measure}: {', '.join(parts)} ({len(values)} runs)"


def interval_of(successes: int, runs: int, *, sequential: bool) -> Interval:
    """Returns the 95 % interval of a rate, for a number of runs that is fixed or that depends on outcomes."""
    return confidence_sequence(successes, runs) if sequential else wilson(successes, runs)


def stop_at(successes: Sequence[bool], until: Until) -> int | None:
    """Returns after how many runs an evaluation ends, or None if these are not enough.

    It looks after 50 runs and then after every 25, at the runs in the order of their seeds.
    """
    for runs in range(FIRST_LOOK, min(len(successes), until.at_most) + 1, LOOK_EVERY):
        interval = confidence_sequence(sum(successes[:runs]), runs, until.confidence)
        if interval.half_width <= until.half_width:
            return runs
    return until.at_most if len(successes) >= until.at_most else None


def _badness(outcome: Outcome) -> tuple[int, float, int]:
    is_judged = outcome.outcome == "failure"
    margins = [item["margin"] for item in outcome.items if not item["holds"] and item["margin"] is not None]
    return is_judged, min(margins, default=0.0), outcome.seed


@dataclass(frozen=True)
class Pairs:
    """Two versions on the same seeds; only runs that count on both sides are pairs."""

    both: tuple[int, ...]
    only_older: tuple[int, ...]
    only_newer: tuple[int, ...]
    neither: tuple[int, ...]
    measures: dict[str, tuple[int, Difference]]

    @property
    def difference(self) -> Difference:
        """The rate of the newer version minus that of the older, with Newcombe's paired interval."""
        return newcombe_paired(len(self.both), len(self.only_newer), len(self.only_older), len(self.neither))

    def lines(self) -> Iterator[str]:
        """Yields the lines that the terminal shows for the comparison."""
        value, low, high = self.difference
        p = mcnemar(len(self.only_older), len(self.only_newer))
        yield (
            f"against the older version: {value:+.1%} (95 % interval {low:+.1%} to {high:+.1%}),"
            f" McNemar p = {p:.4f}"
        )
        if self.only_older:
            yield f"    only the older version succeeds: seeds {_listed(self.only_older)}"
        if self.only_newer:
            yield f"    only the newer version succeeds: seeds {_listed(self.only_newer)}"
        for name, (count, (mean, lowest, highest)) in self.measures.items():
            yield (
                f"    {name}: {mean:+.4g} (95 % interval {lowest:+.4g} to {highest:+.4g}, {count} pairs,"
                " not corrected for many comparisons)"
            )


@dataclass(frozen=True)
class Apart:
    """Two versions, each in its own world: their runs are no pairs, whatever their seeds are."""

    older: Summary
    newer: Summary

    def lines(self) -> Iterator[str]:
        """Yields the lines that the terminal shows for the comparison."""
        older, newer = self.older, self.newer
        value, low, high = newcombe(newer.successes, newer.counted, older.successes, older.counted)
        yield (
            f"against the older version, each in its own world: {value:+.1%} (95 % interval {low:+.1%} to"
            f" {high:+.1%}, not paired); the older one: {older.successes} of {older.counted}"
        )
        before = older.measures
        for name, values in newer.measures.items():
            if name in before:
                then, now = quantile(before[name], 0.5), quantile(values, 0.5)
                yield f"    {name}: median {then:.4g} before, {now:.4g} now"


def pair(older: Sequence[Outcome], newer: Sequence[Outcome]) -> Pairs:
    """Returns the comparison of two versions."""
    before = {outcome.seed: outcome for outcome in older if outcome.is_counted}
    pairs = [(before[now.seed], now) for now in newer if now.is_counted and now.seed in before]
    cells: dict[tuple[bool, bool], list[int]] = {}
    for then, now in pairs:
        cells.setdefault((then.is_success, now.is_success), []).append(now.seed)
    measures: dict[str, tuple[int, Difference]] = {}
    for name in dict.fromkeys(name for _, now in pairs for name in now.measures):
        differences = [
            now.measures[name] - then.measures[name]
            for then, now in pairs
            if name in now.measures and name in then.measures
        ]
        if differences:
            measures[name] = (len(differences), bootstrap_paired(differences))

    def seeds(then: bool, now: bool) -> tuple[int, ...]:  # noqa: FBT001 - a table of two by two
        return tuple(cells.get((then, now), ()))

    return Pairs(seeds(True, True), seeds(True, False), seeds(False, True), seeds(False, False), measures)  # noqa: FBT003


def _listed(seeds: Sequence[int]) -> str:
    shown = ", ".join(map(str, seeds[:20]))
    return f"{shown} and {len(seeds) - 20} more" if len(seeds) > 20 else shown
