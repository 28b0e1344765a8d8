"""Summaries of outcomes."""

import pytest

from executor.evaluation.document import Until
from executor.evaluation.outcome import Outcome
from executor.evaluation.statistics import confidence_sequence, wilson
from executor.evaluation.summary import Summary, interval_of, pair, stop_at


def outcome(seed, name="success", margin=None, **measures):
    items = (
        [] if margin is None else [{"item": "x", "holds": False, "at_s": 1, "margin": margin, "unit": "m"}]
    )
    return Outcome(seed, name, items=items, measures=measures)


def test_crashes_count_as_failures_and_invalid_runs_do_not_count():
    found = [
        outcome(0),
        outcome(1, "failure"),
        outcome(2, "crashed"),
        outcome(3, "timeout"),
        outcome(4, "invalid"),
    ]
    summary = Summary(tuple(found), 5)
    assert (summary.successes, summary.counted, summary.rate) == (1, 4, 0.25)
    assert not summary.is_complete
    assert summary.interval == wilson(1, 4)
    assert "incomplete: 4 of 5 runs count" in "\n".join(summary.lines("room"))
    assert Summary(tuple(found[:4]), 4).is_complete
    assert not Summary((), 0).is_complete


def test_measures_say_for_how_many_runs_they_are_defined():
    summary = Summary((outcome(0, a=1), outcome(1), outcome(2, a=3), outcome(3, "lost", a=9)), 4)
    assert summary.measures == {"a": [1, 3]}
    assert "a: p5 1, p50 1, p95 3 (2 runs)" in "\n".join(summary.lines("room"))


def test_the_worst_are_crashes_and_then_those_that_missed_by_most():
    found = (outcome(0), outcome(1, "failure", -0.1), outcome(2, "failure", -0.9), outcome(3, "error"))
    assert [each.seed for each in Summary(found, 4).worst()] == [3, 2, 1]


def test_runs_stop_at_looks_of_their_own_order_alone():
    until = Until(half_width=0.1, at_most=300)
    successes = [True] * 300
    stop = stop_at(successes, until)
    assert stop is not None
    assert stop % 25 == 0
    assert stop >= 50
    assert confidence_sequence(stop, stop).half_width <= 0.1
    assert stop_at(successes[: stop - 1], until) is None
    mixed = [True, False] * 150
    assert stop_at(mixed, until) == 300
    assert stop_at(mixed[:299], until) is None
    assert interval_of(3, 5, sequential=True) == confidence_sequence(3, 5)


def test_pairs():
    older = [
        outcome(0, a=1),
        outcome(1, "failure", a=2),
        outcome(2, "failure"),
        outcome(3),
        outcome(4, "lost"),
    ]
    newer = [outcome(0, a=2), outcome(1, a=4), outcome(2, "error"), outcome(3, "failure"), outcome(4)]
    pairs = pair(older, newer)
    assert (pairs.both, pairs.only_newer, pairs.neither, pairs.only_older) == ((0,), (1,), (2,), (3,))
    assert pairs.difference.value == 0
    assert pairs.measures["a"][0] == 2
    assert pairs.measures["a"][1].value == pytest.approx(1.5)
    text = "\n".join(pairs.lines())
    assert "only the older version succeeds: seeds 3" in text
    assert "only the newer version succeeds: seeds 1" in text
    assert "not corrected for many comparisons" in text
