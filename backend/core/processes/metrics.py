"""Counters and histograms of this process and its siblings, in sum.

Names are `bt_studio_<noun>_<unit>`. Every value of a label exists before it first happens, so that a rate
over it is right from the start. `backend/config/metrics_page.py` writes them for Prometheus.
"""

from __future__ import annotations

from bisect import bisect_left
from threading import Lock
from typing import Final

from backend.core.processes.numbers import numbers

BUCKETS_S: Final = (0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0)


class Counter:
    """A number that only grows, for each value of one label."""

    def __init__(self, name: str, help_text: str, label: str, values: tuple[str, ...]) -> None:
        self.name, self.help_text, self.label = name, help_text, label
        first = numbers.take(len(values))
        self._places = {value: first + index for index, value in enumerate(values)}
        self._lock = Lock()

    def add(self, value: str, amount: int = 1) -> None:
        """Counts one more; a value that was not declared is an error of ours.

        Raises:
            KeyError: there is no such value.
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
        """Adds one."""
        with self._lock:
            numbers.add(self._first + bisect_left(BUCKETS_S, seconds), 1)
            numbers.add(self._sum_s, seconds)

    def buckets(self) -> list[tuple[str, float]]:
        """Returns the bounds with the sums over all workers; each bucket also holds those before it."""
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
