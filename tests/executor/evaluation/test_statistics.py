"""Statistics against values of scipy and statsmodels (`statistics_reference.py`), and by simulation."""

import json
import math
from pathlib import Path

import numpy as np
import pytest

from executor.evaluation import statistics
from executor.evaluation.document import Until
from executor.evaluation.summary import stop_at
from tests.budget import count

REFERENCE = json.loads(Path(__file__).with_name("statistics_reference.json").read_text())


def close(expected):
    return pytest.approx(expected, abs=1e-9, rel=1e-9)


@pytest.mark.parametrize("row", REFERENCE["rates"], ids=lambda row: f"{row['successes']} of {row['runs']}")
def test_intervals_of_a_rate(row):
    s, n = row["successes"], row["runs"]
    assert statistics.wilson(s, n) == close(row["wilson"])
    assert statistics.clopper_pearson(s, n) == close(row["clopper_pearson"])
    assert statistics.lower_bound(s, n) == close(row["lower_bound"])
    assert statistics.upper_bound(n - s, n) == pytest.approx(1 - row["lower_bound"])
    assert statistics.confidence_sequence(s, n) == pytest.approx(row["sequence"], abs=1e-7)


@pytest.mark.parametrize("row", REFERENCE["mcnemar"], ids=lambda row: f"{row['first']}, {row['second']}")
def test_mcnemar(row):
    assert statistics.mcnemar(row["first"], row["second"]) == close(row["p"])
    assert statistics.mcnemar_worse(row["first"], row["second"]) == close(row["worse"])


# With 99 and 93 of 100, every table of pairs is correlated, so that there is nothing to compare with.
@pytest.mark.parametrize(
    "row", REFERENCE["newcombe_without_correlation"][:2], ids=lambda row: str(row["runs"])
)
def test_newcombe_without_correlation_is_that_of_independent_rates(row):
    s1, s2, n = row["first"], row["second"], row["runs"]
    both = math.ceil(s1 * s2 / n)  # hardly any correlation: the correction for continuity leaves none
    found = statistics.newcombe_paired(both, s1 - both, s2 - both, n - s1 - s2 + both)
    assert found[1:] == close(row["interval"])


@pytest.mark.parametrize("row", REFERENCE["newcombe_without_correlation"], ids=lambda row: str(row["runs"]))
def test_newcombe_of_independent_rates(row):
    found = statistics.newcombe(row["first"], row["runs"], row["second"], row["runs"])
    assert found[1:] == close(row["interval"])
    assert statistics.newcombe(1, 1, 0, 0) == (0, -1, 1)


@pytest.mark.parametrize("row", REFERENCE["correlations"], ids=lambda row: str(row["table"]))
def test_the_correlation_of_pairs_narrows_the_interval(row):
    a, b, c, d = row["table"]
    many = 10_000  # with so many pairs the correction for continuity vanishes
    found = statistics.newcombe_paired(a * many, b * many, c * many, d * many)
    n = (a + b + c + d) * many
    p1, p2 = (a + b) * many / n, (a + c) * many / n
    v1, v2 = p1 * (1 - p1), p2 * (1 - p2)
    half = 1.959964 * np.sqrt((v1 + v2 - 2 * row["phi"] * np.sqrt(v1 * v2)) / n)
    assert found.value == pytest.approx(p1 - p2)
    assert (found.high - found.low) / 2 == pytest.approx(half, rel=0.02)


def test_the_bootstrap():
    row = REFERENCE["bootstrap"]
    found = statistics.bootstrap_paired(row["values"])
    assert found.value == pytest.approx(np.mean(row["values"]))
    assert found[1:] == pytest.approx([row["low"], row["high"]], abs=0.01)
    assert statistics.bootstrap_paired(row["values"]) == found
    with pytest.raises(ValueError, match="no pairs"):
        statistics.bootstrap_paired([])


def test_quantiles_and_fewest_runs():
    assert statistics.quantile([3, 1, 2, 4], 0.5) == 2
    assert statistics.quantile(list(range(1, 101)), 0.95) == 95
    assert statistics.quantile([7], 0.01) == 7
    with pytest.raises(ValueError, match="no values"):
        statistics.quantile([], 0.5)
    assert statistics.fewest_runs(0.95) == 59
    for rate in (0.5, 0.9, 0.95, 0.99):
        fewest = statistics.fewest_runs(rate)
        assert statistics.lower_bound(fewest, fewest) >= rate
        assert fewest == 1 or statistics.lower_bound(fewest - 1, fewest - 1) < rate


@pytest.mark.parametrize("rate", [0.5, 0.8, 0.9, 0.95, 0.99])
def test_what_is_reported_holds_also_when_runs_stop_by_their_outcomes(rate):
    until = Until(half_width=0.08, at_most=400)
    generator = np.random.default_rng(round(rate * 100))
    trials, held = count("evaluation_coverage"), 0
    for _ in range(trials):
        runs = (generator.random(until.at_most) < rate).tolist()
        stop = stop_at(runs, until)
        low, high = statistics.confidence_sequence(sum(runs[:stop]), stop)
        held += low <= rate <= high
    assert held / trials >= 0.94
