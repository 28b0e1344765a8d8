"""Gates."""

import pytest

from executor.evaluation.gates import GateError, check_gate, read_gate, warnings
from executor.evaluation.outcome import Outcome
from executor.evaluation.summary import Summary, pair


def summary(successes, runs, *, wanted=None, sequential=False):
    outcomes = [
        Outcome(seed, "success" if seed < successes else "failure", measures={"m": float(seed)})
        for seed in range(runs)
    ]
    return Summary(tuple(outcomes), wanted or runs, sequential)


def passes(text, results, pairs=None):
    return check_gate(read_gate(text), results, pairs).passes


def test_the_lower_bound_decides_and_not_the_rate():
    assert passes("success>=0.95", summary(59, 59))
    assert not passes("success>=0.95", summary(58, 58))
    assert not passes("success >= 0.95", summary(96, 100))
    assert passes("rate(success)>=0.95", summary(96, 100))
    assert not passes("rate(success)>=0.97", summary(96, 100))


def test_after_stopping_by_outcomes_the_bound_is_that_of_the_confidence_sequence():
    assert not passes("success>=0.95", summary(59, 59, sequential=True))
    assert passes("success>=0.95", summary(140, 140, sequential=True))


def test_quantiles():
    assert passes("p95(m)<=94", summary(100, 100))
    assert not passes("p95(m)<=93", summary(100, 100))
    assert passes("p5(m)>=4", summary(100, 100))
    assert not passes("p50(other)<=4", summary(100, 100))


def test_an_incomplete_evaluation_passes_no_gate():
    for text in ("success>=0.5", "rate(success)>=0.1", "p50(m)<=1000", "no-worse"):
        verdict = check_gate(read_gate(text), summary(100, 100, wanted=101))
        assert not verdict.passes
        assert "incomplete" in str(verdict)


def test_no_worse():
    better, worse = summary(20, 20), summary(10, 20)
    assert passes("no-worse", better, pair(worse.outcomes, better.outcomes))
    assert not passes("no-worse", worse, pair(better.outcomes, worse.outcomes))
    few = summary(18, 20)
    assert passes("no-worse", few, pair(better.outcomes, few.outcomes))  # two seeds show nothing
    assert not passes("no-worse", better)


@pytest.mark.parametrize(
    "text", ["", "success>0.5", "success>=0", "success>=1.5", "success>=0.9.5", "p95<=3", "better"]
)
def test_other_texts_are_refused(text):
    with pytest.raises(GateError):
        read_gate(text)


def test_what_cannot_pass_is_said_before():
    assert warnings(read_gate("success>=0.95"), 58, []) == [
        "gate success>=0.95 cannot pass with 58 runs: it needs at least 59 of 59"
    ]
    assert warnings(read_gate("success>=0.95"), 59, []) == []
    assert "cannot pass" in warnings(read_gate("success>=1"), 10_000, [])[0]
    assert "does not measure x" in warnings(read_gate("p95(x)<=1"), 10, ["m"])[0]
