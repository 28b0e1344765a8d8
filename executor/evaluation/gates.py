"""Gates: conditions on the results of an evaluation, for CI."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from executor.evaluation.statistics import (
    confidence_sequence,
    fewest_runs,
    lower_bound,
    mcnemar_worse,
    quantile,
)

if TYPE_CHECKING:
    from collections.abc import Collection

    from executor.evaluation.summary import Pairs, Summary

NO_WORSE: Final = "no-worse"
SIGNIFICANT: Final = 0.05
_BOUND: Final = re.compile(r"success\s*>=\s*([0-9.]+)")
_RATE: Final = re.compile(r"rate\(success\)\s*>=\s*([0-9.]+)")
_QUANTILE: Final = re.compile(r"p(\d{1,2}(?:\.\d+)?)\(([^()]+)\)\s*(<=|>=)\s*(-?[0-9.]+(?:e-?\d+)?)")


class GateError(ValueError):
    """A gate cannot be read; the text says why."""


@dataclass(frozen=True)
class Gate:
    """One gate. `kind` is bound, rate, quantile or no-worse; `share` is that of a quantile."""

    text: str
    kind: str
    limit: float = 0.0
    measure: str = ""
    share: float = 0.0
    at_most: bool = False


@dataclass(frozen=True)
class Verdict:
    """Whether a gate passes, and why."""

    gate: Gate
    passes: bool
    why: str

    def __str__(self) -> str:
        return f"gate {self.gate.text}: {'passes' if self.passes else 'FAILS'}: {self.why}"


def read_gate(text: str) -> Gate:
    """Reads a gate: `success>=0.95`, `rate(success)>=0.95`, `p95(path_length_m)<=12` or `no-worse`.

    Raises:
        GateError: it is something else.
    """
    text = text.strip()
    if text == NO_WORSE:
        return Gate(text, NO_WORSE)
    for kind, pattern in (("bound", _BOUND), ("rate", _RATE)):
        if found := pattern.fullmatch(text):
            limit = _number(found[1], text)
            if not 0 < limit <= 1:
                raise GateError(f"{text!r}: a rate is more than 0 and at most 1")
            return Gate(text, kind, limit)
    if found := _QUANTILE.fullmatch(text):
        share, limit = _number(found[1], text) / 100, _number(found[4], text)
        return Gate(text, "quantile", limit, found[2].strip(), share, found[3] == "<=")
    hint = "write success>=0.95, rate(success)>=0.95, p95(path_length_m)<=12 or no-worse"
    raise GateError(f"{text!r} is no gate: {hint}")


def _number(text: str, gate: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise GateError(f"{gate!r}: {text!r} is no number") from None


def warnings(gate: Gate, runs: int, measures: Collection[str]) -> list[str]:
    """Returns why a gate cannot pass with so many runs, before any of them."""
    if gate.kind == "bound" and gate.limit >= 1:
        return [f"gate {gate.text} cannot pass: no number of runs shows a rate of 1; use rate(success)>=1"]
    if gate.kind == "bound" and runs < fewest_runs(gate.limit):
        fewest = fewest_runs(gate.limit)
        return [f"gate {gate.text} cannot pass with {runs} runs: it needs at least {fewest} of {fewest}"]
    if gate.kind == "quantile" and gate.measure not in measures:
        return [f"gate {gate.text}: the evaluation does not measure {gate.measure}; add it to `measure`"]
    return []


def check_gate(  # noqa: PLR0911 - one a kind
    gate: Gate, summary: Summary, pairs: Pairs | None = None
) -> Verdict:
    """Returns whether a gate passes.

    Args:
        gate: the gate.
        summary: the results.
        pairs: the comparison with another version, if there is one.
    """
    if not summary.is_complete:
        return Verdict(gate, False, "the evaluation is incomplete")  # noqa: FBT003 - a verdict
    if gate.kind == "bound":
        runs, successes = summary.counted, summary.successes
        low = confidence_sequence(successes, runs).low if summary.sequential else lower_bound(successes, runs)
        return Verdict(gate, low >= gate.limit, f"the 95 % lower bound is {low:.4f} ({successes} of {runs})")
    if gate.kind == "rate":
        return Verdict(gate, summary.rate >= gate.limit, f"the rate is {summary.rate:.4f}")
    if gate.kind == "quantile":
        values = summary.measures.get(gate.measure, [])
        if not values:
            return Verdict(gate, False, f"{gate.measure} is defined for no run")  # noqa: FBT003
        value = quantile(values, gate.share)
        passes = value <= gate.limit if gate.at_most else value >= gate.limit
        return Verdict(gate, passes, f"it is {value:.6g} in {len(values)} runs")
    if pairs is None:
        return Verdict(gate, False, "there is no other version to compare with (--against)")  # noqa: FBT003
    p = mcnemar_worse(len(pairs.only_older), len(pairs.only_newer))
    older, newer = len(pairs.only_older), len(pairs.only_newer)
    why = f"p = {p:.4f}: on {older} seeds only the older version succeeds, on {newer} only the newer"
    return Verdict(gate, p >= SIGNIFICANT, why)
