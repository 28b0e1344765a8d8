"""Writes reference values of the statistics: `python -m tests.executor.evaluation.statistics_reference`.

It needs scipy and statsmodels, which the tests do not: install them in an environment of their own, and
commit the file that it writes.
"""

from __future__ import annotations

import importlib
import json
from pathlib import Path
from typing import Any

import numpy as np

# Not declared as dependencies, since no test needs them.
optimize, special, stats = (
    importlib.import_module(f"scipy.{name}") for name in ("optimize", "special", "stats")
)
mcnemar: Any = importlib.import_module("statsmodels.stats.contingency_tables").mcnemar
proportion: Any = importlib.import_module("statsmodels.stats.proportion")

FILE = Path(__file__).with_name("statistics_reference.json")
RATES = [(0, 1), (0, 50), (1, 50), (25, 50), (49, 50), (50, 50), (59, 59), (191, 200), (475, 500), (3, 2000)]
PAIRS = [(0, 1), (1, 1), (2, 9), (10, 3), (0, 12), (40, 61), (300, 250)]
TABLES = [(10, 5, 7, 8), (20, 12, 2, 16), (90, 6, 3, 1), (0, 5, 9, 30)]


def sequence(successes: int, runs: int) -> list[float]:
    """Returns the confidence sequence by scipy's root finder and functions."""
    failures = runs - successes
    fixed = special.betaln(successes + 0.5, failures + 0.5) - special.betaln(0.5, 0.5)

    def excess(p: float) -> float:
        return float(fixed - special.xlogy(successes, p) - special.xlogy(failures, 1 - p) - np.log(20))

    rate = successes / runs
    tiny = 1e-12
    low = (
        0.0
        if excess(tiny) < 0
        else optimize.brentq(excess, tiny, max(rate, tiny) if rate < 1 else 1 - tiny, xtol=1e-14)
    )
    high = (
        1.0
        if excess(1 - tiny) < 0
        else optimize.brentq(excess, min(rate, 1 - tiny) if rate > 0 else tiny, 1 - tiny, xtol=1e-14)
    )
    return [low, high]


def bootstrap() -> dict[str, Any]:
    """Returns a sample with the percentile interval of its mean."""
    values = np.random.default_rng(4).normal(0.3, 1.0, 80)
    found = stats.bootstrap(
        (values,), np.mean, n_resamples=100_000, method="percentile", rng=np.random.default_rng(5)
    )
    interval = found.confidence_interval
    return {"values": values.tolist(), "low": interval.low, "high": interval.high}


def main() -> None:
    """Writes the values."""
    document = {
        "rates": [
            {
                "successes": s,
                "runs": n,
                "wilson": list(proportion.proportion_confint(s, n, 0.05, "wilson")),
                "clopper_pearson": list(proportion.proportion_confint(s, n, 0.05, "beta")),
                "lower_bound": float(stats.beta.ppf(0.05, s, n - s + 1)) if s else 0.0,
                "sequence": sequence(s, n),
            }
            for s, n in RATES
        ],
        "mcnemar": [
            {
                "first": b,
                "second": c,
                "p": float(mcnemar([[0, b], [c, 0]], exact=True).pvalue),
                "worse": float(stats.binomtest(c, b + c, 0.5, alternative="less").pvalue),
            }
            for b, c in PAIRS
        ],
        "newcombe_without_correlation": [
            {
                "first": s1,
                "second": s2,
                "runs": n,
                "interval": list(
                    proportion.confint_proportions_2indep(s1, n, s2, n, method="newcomb", compare="diff")
                ),
            }
            for s1, s2, n in [(15, 17, 30), (30, 20, 50), (99, 93, 100)]
        ],
        "correlations": [
            {
                "table": [a, b, c, d],
                "phi": float(
                    np.corrcoef([1] * (a + b) + [0] * (c + d), [1] * a + [0] * b + [1] * c + [0] * d)[0, 1]
                ),
            }
            for a, b, c, d in TABLES
        ],
        "bootstrap": bootstrap(),
    }
    FILE.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
