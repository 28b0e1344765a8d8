"""The page `/metrics`: sums over all workers and current numbers, in Prometheus' text format.

The multiprocess mode of `prometheus_client` is not used, since it keeps files of every process that ever ran.
The workers share memory instead, which outlives a worker and is released with the server (`numbers.py`). Only
the registry, the metric families and the text format of the library are used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from prometheus_client import CONTENT_TYPE_PLAIN_0_0_4, CollectorRegistry, generate_latest
from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, HistogramMetricFamily

from backend.core.processes import metrics
from backend.sessions.queries import counts
from backend.workers.priorities import pool

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from prometheus_client import Metric

CONTENT_TYPE: Final = CONTENT_TYPE_PLAIN_0_0_4


class Counted:
    """Collects counters and histograms, summed over all workers."""

    def collect(self) -> Iterator[Metric]:
        yield counter_family(metrics.requests)
        yield histogram_family(metrics.request_seconds)
        yield counter_family(metrics.sockets)


class Current:
    """Collects the current numbers of sessions and waiting jobs."""

    def collect(self) -> Iterator[Metric]:
        yield _gauges("bt_studio_sessions", "Executors by state.", counts())
        yield _gauges("bt_studio_work_jobs", "Work for the pool of processes.", {"waiting": pool().waiting})


def counter_family(counter: metrics.Counter) -> CounterMetricFamily:
    """Returns a counter with one sample for each value of its label."""
    family = CounterMetricFamily(counter.name, counter.help_text, labels=[counter.label])
    for value, total in counter.totals().items():
        family.add_metric([value], total)
    return family


def histogram_family(histogram: metrics.Histogram) -> HistogramMetricFamily:
    """Returns a histogram with its buckets."""
    buckets, total_s = histogram.buckets(), histogram.sum_s()
    return HistogramMetricFamily(histogram.name, histogram.help_text, buckets=buckets, sum_value=total_s)


def _gauges(name: str, help_text: str, values: Mapping[str, float]) -> GaugeMetricFamily:
    family = GaugeMetricFamily(name, help_text, labels=["state"])
    for state, value in values.items():
        family.add_metric([state], value)
    return family


_registry: Final = CollectorRegistry()
_registry.register(Counted())
_registry.register(Current())


def page() -> str:
    """Returns the page."""
    return generate_latest(_registry).decode()
