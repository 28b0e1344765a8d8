"""Counters and histograms, summed over this process and its siblings.

Names are `bt_studio_<noun>_<unit>`. Every value of a label is declared and starts at 0, so that Prometheus
computes correct rates from the first event on. `backend/config/metrics_page.py` writes the page.
"""

from __future__ import annotations

from bisect import bisect_left
from threading import Lock
from typing import Final

from backend.core.processes.numbers import numbers

BUCKETS_S: Final = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0)


class Counter:
    """A counter with one label; it has a separate count for each value of the label."""

    def __init__(self, name: str, help_text: str, label: str, values: tuple[str, ...]) -> None:
        self.name, self.help_text, self.label = name, help_text, label
        first = numbers.take(len(values))
        self._places = {value: first + index for index, value in enumerate(values)}
        self._lock = Lock()

    def add(self, value: str, amount: int = 1) -> None:
        """Adds to the count of a value of the label.

        Raises:
            KeyError: the value was not declared.
        """
        with self._lock:
            numbers.add(self._places[value], amount)

    def totals(self) -> dict[str, float]:
        """Returns the sum over all workers for each value of the label."""
        return {value: numbers.total(place) for value, place in self._places.items()}


class Histogram:
    """A histogram of durations."""

    def __init__(self, name: str, help_text: str) -> None:
        self.name, self.help_text = name, help_text
        self._first = numbers.take(len(BUCKETS_S) + 2)
        self._sum_s = self._first + len(BUCKETS_S) + 1
        self._lock = Lock()

    def observe(self, seconds: float) -> None:
        """Adds a duration."""
        with self._lock:
            numbers.add(self._first + bisect_left(BUCKETS_S, seconds), 1)
            numbers.add(self._sum_s, seconds)

    def buckets(self) -> list[tuple[str, float]]:
        """Returns the bounds of the buckets with the counts of all workers.

        Counts are cumulative, as Prometheus expects.
        """
        found, count = [], 0.0
        for index, bound in enumerate([*map(str, BUCKETS_S), "+Inf"]):
            count += numbers.total(self._first + index)
            found.append((bound, count))
        return found

    def sum_s(self) -> float:
        """Returns the sum of all durations."""
        return numbers.total(self._sum_s)


requests: Final = Counter(
    "bt_studio_requests_total",
    "HTTP requests by class of status.",
    "status",
    ("1xx", "2xx", "3xx", "4xx", "5xx"),
)
request_seconds: Final = Histogram("bt_studio_request_seconds", "Time to the end of the answer.")
sockets: Final = Counter(
    "bt_studio_sockets_total", "Websockets opened and ended.", "event", ("opened", "ended")
)
