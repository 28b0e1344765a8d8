"""Counters and histograms in Prometheus' text format: those of this process and its siblings, in sum.

Names are `bt_studio_<noun>_<unit>`. Every value of a label exists before it first happens, so that a rate
over it is right from the start.
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
        self._head = f"# HELP {name} {help_text}\n# TYPE {name} counter\n"
        self._name, self._label = name, label
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

    def text(self) -> str:
        """As Prometheus reads it."""
        rows = (
            f'{self._name}{{{self._label}="{value}"}} {numbers.total(place):.0f}\n'
            for value, place in self._places.items()
        )
        return self._head + "".join(rows)


class Histogram:
    """A histogram of durations."""

    def __init__(self, name: str, help_text: str) -> None:
        self._head = f"# HELP {name} {help_text}\n# TYPE {name} histogram\n"
        self._name = name
        self._first = numbers.take(len(BUCKETS_S) + 2)
        self._sum_s = self._first + len(BUCKETS_S) + 1
        self._lock = Lock()

    def observe(self, seconds: float) -> None:
        """Adds one."""
        with self._lock:
            numbers.add(self._first + bisect_left(BUCKETS_S, seconds), 1)
            numbers.add(self._sum_s, seconds)

    def text(self) -> str:
        """As Prometheus reads it: each bucket holds those before it, too."""
        buckets = [int(numbers.total(self._first + index)) for index in range(len(BUCKETS_S) + 1)]
        total_s = numbers.total(self._sum_s)
        rows, count = [], 0
        for bound, n in zip([*map(str, BUCKETS_S), "+Inf"], buckets, strict=True):
            count += n
            rows.append(f'{self._name}_bucket{{le="{bound}"}} {count}\n')
        return self._head + "".join(rows) + f"{self._name}_sum {total_s:.6f}\n{self._name}_count {count}\n"


def gauges(name: str, help_text: str, label: str, values: dict[str, float]) -> str:
    """Numbers of this moment, as Prometheus reads them."""
    rows = (f'{name}{{{label}="{key}"}} {value:g}\n' for key, value in values.items())
    return f"# HELP {name} {help_text}\n# TYPE {name} gauge\n" + "".join(rows)


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
