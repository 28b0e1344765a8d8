"""Counters and histograms in Prometheus' format."""

from __future__ import annotations

import pytest

from backend.core.processes.metrics import BUCKETS_S, Counter, Histogram, gauges


def test_a_counter_has_all_its_labels_from_the_start() -> None:
    counter = Counter("bt_studio_test_total", "Tests.", "kind", ("good", "bad"))
    counter.add("good", 2)
    assert 'bt_studio_test_total{kind="good"} 2\n' in counter.text()
    assert 'bt_studio_test_total{kind="bad"} 0\n' in counter.text()
    with pytest.raises(KeyError):
        counter.add("ugly")


def test_each_bucket_holds_those_before_it() -> None:
    histogram = Histogram("bt_studio_test_seconds", "Tests.")
    for seconds in (0.001, 0.03, 99.0):
        histogram.observe(seconds)
    lines = histogram.text().splitlines()
    assert f'bt_studio_test_seconds_bucket{{le="{BUCKETS_S[0]}"}} 1' in lines
    assert 'bt_studio_test_seconds_bucket{le="+Inf"} 3' in lines
    assert "bt_studio_test_seconds_count 3" in lines


def test_gauges_are_numbers_of_this_moment() -> None:
    text = gauges("bt_studio_x", "X.", "state", {"ready": 2.0})
    assert text.splitlines()[-1] == 'bt_studio_x{state="ready"} 2'
