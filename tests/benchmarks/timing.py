"""Measures processor time, memory and the times of calls, for benchmarks."""

from __future__ import annotations

import contextlib
import gc
import math
import statistics
import time
import tracemalloc
from pathlib import Path
from typing import TYPE_CHECKING

import psutil

if TYPE_CHECKING:
    from collections.abc import Callable


LEAST_S = 0.03
"""How long a function is called for one measurement, unless another time is given."""


def race(*functions: Callable[[], object], least_s: float | None = None, rounds: int = 7) -> list[float]:
    """Returns microseconds of processor time for a call of each function: the best of alternating rounds."""
    least_s = LEAST_S if least_s is None else least_s
    calls = []
    for function in functions:
        function()
        start = time.thread_time()
        function()
        calls.append(max(1, int(least_s / max(time.thread_time() - start, 1e-6))))
    best = [float("inf")] * len(functions)
    for _ in range(rounds):
        for index, function in enumerate(functions):
            gc.collect()
            start = time.thread_time()
            for _ in range(calls[index]):
                function()
            best[index] = min(best[index], (time.thread_time() - start) / calls[index])
    return [seconds * 1e6 for seconds in best]


def median_ms(act: Callable[[], object], count: int) -> float:
    """Returns the median duration of a function in ms, by the clock."""
    times = []
    for _ in range(count):
        began_s = time.perf_counter()
        act()
        times.append((time.perf_counter() - began_s) * 1000)
    return statistics.median(times)


def best_s(work: Callable[[], object], repeats: int = 3) -> float:
    """Returns the least processor time of a few calls in this process, in s."""
    times = []
    for _ in range(repeats):
        started = time.process_time()
        work()
        times.append(time.process_time() - started)
    return min(times)


def peak_mb(work: Callable[[], object]) -> float:
    """Returns the most memory that Python's objects take in one call, in MB."""
    tracemalloc.start()
    try:
        work()
        return tracemalloc.get_traced_memory()[1] / 1e6
    finally:
        tracemalloc.stop()


def p95(values: list[float]) -> float:
    """The value that 95 of 100 do not exceed."""
    return sorted(values)[math.ceil(0.95 * len(values)) - 1]


def processor_s(*processes: psutil.Process) -> float:
    """Returns the processor time of these processes so far; one that has just ended has none."""
    spent_s = 0.0
    for each in processes:
        with contextlib.suppress(psutil.NoSuchProcess):
            times = each.cpu_times()
            spent_s += times.user + times.system
    return spent_s


def pss_mb(pid: int) -> float:
    """The proportional memory of a process and all below it, in MB; one that has just ended has none."""
    total = 0
    with contextlib.suppress(psutil.NoSuchProcess):
        family = [psutil.Process(pid), *psutil.Process(pid).children(recursive=True)]
        for process in family:
            with contextlib.suppress(ProcessLookupError, FileNotFoundError):
                text = Path(f"/proc/{process.pid}/smaps_rollup").read_text()
                total += int(next(line.split()[1] for line in text.splitlines() if line.startswith("Pss:")))
    return total / 1000
