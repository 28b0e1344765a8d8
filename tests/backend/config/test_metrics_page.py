"""The metrics of the web server, as a reader of Prometheus' format finds them."""

from __future__ import annotations

import pytest
from prometheus_client.parser import text_string_to_metric_families

from backend.config.metrics_page import counter_family, histogram_family, page
from backend.core.processes.metrics import BUCKETS_S, Counter, Histogram

pytestmark = pytest.mark.django_db

# Users' dashboards and alerts depend on these names.
SERIES = {
    **{("bt_studio_requests_total", "status", f"{n}xx"): "counter" for n in range(1, 6)},
    **{("bt_studio_request_seconds_bucket", "le", str(b)): "histogram" for b in (*BUCKETS_S, "+Inf")},
    ("bt_studio_request_seconds_count", "", ""): "histogram",
    ("bt_studio_request_seconds_sum", "", ""): "histogram",
    ("bt_studio_sockets_total", "event", "opened"): "counter",
    ("bt_studio_sockets_total", "event", "ended"): "counter",
    ("bt_studio_sessions", "state", "queued"): "gauge",
    ("bt_studio_sessions", "state", "starting"): "gauge",
    ("bt_studio_sessions", "state", "ready"): "gauge",
    ("bt_studio_work_jobs", "state", "waiting"): "gauge",
}


def test_the_page_has_the_same_series_as_ever():
    found = {
        (sample.name, *next(iter(sample.labels.items()), ("", ""))): family.type
        for family in text_string_to_metric_families(page())
        for sample in family.samples
    }
    assert found == SERIES


def test_a_counter_has_a_sample_for_each_value():
    counter = Counter("x_total", "X.", "kind", ("a", "b"))
    counter.add("b", 3)
    samples = counter_family(counter).samples
    assert [(s.name, s.labels, s.value) for s in samples] == [
        ("x_total", {"kind": "a"}, 0),
        ("x_total", {"kind": "b"}, 3),
    ]


def test_a_histogram_has_its_buckets_with_count_and_sum():
    histogram = Histogram("x_seconds", "X.")
    histogram.observe(0.3)
    values = {(s.name, s.labels.get("le")): s.value for s in histogram_family(histogram).samples}
    assert values["x_seconds_bucket", "0.25"] == 0
    assert values["x_seconds_bucket", "0.5"] == values["x_seconds_count", None] == 1
    assert values["x_seconds_sum", None] == pytest.approx(0.3)
