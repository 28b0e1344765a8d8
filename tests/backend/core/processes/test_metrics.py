"""Counting of requests and their times."""

from __future__ import annotations

import pytest

from backend.core.processes.metrics import Counter, Histogram


def test_histograms_add_up():
    histogram = Histogram("x_seconds", "X.")
    for seconds in (0.001, 0.3, 99):
        histogram.observe(seconds)
    buckets = dict(histogram.buckets())
    assert (buckets["0.005"], buckets["0.25"], buckets["0.5"], buckets["+Inf"]) == (1, 1, 2, 3)
    assert histogram.sum_s() == pytest.approx(99.301)


def test_every_value_of_a_label_exists_before_it_first_happens():
    counter = Counter("x_total", "X.", "kind", ("a", "b"))
    counter.add("b", 2)
    assert counter.totals() == {"a": 0, "b": 2}
    with pytest.raises(KeyError):
        counter.add("c")
