"""The work of the browser's main thread, from a trace of the DevTools protocol."""

from __future__ import annotations

import math
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import CDPSession

CATEGORIES = ["devtools.timeline", "toplevel", "__metadata", "v8"]
# Every task of the thread, whatever it does inside.
TASK = "ThreadControllerImpl::RunTask"
# Script, style and layout: the work that a page's author can influence. Nested calls are included.
WORK = frozenset(
    {
        "EventDispatch",
        "FunctionCall",
        "EvaluateScript",
        "v8.compile",
        "FireAnimationFrame",
        "FireIdleCallback",
        "TimerFire",
        "RunMicrotasks",
        "ParseHTML",
        "UpdateLayoutTree",
        "Layout",
    }
)
# The main thread's later work for the picture; other threads rasterise it.
PAINT = frozenset({"PrePaint", "Paint", "Layerize", "Commit"})
Event = dict[str, Any]


@dataclass
class Trace:
    """The events of the page's main thread while it was recorded."""

    events: list[Event] = field(default_factory=list)

    def begins(self, kinds: frozenset[str]) -> list[float]:
        """Returns the time in ms of the first DOM event of each input: one for each frame of a gesture."""
        return [
            event["ts"] / 1000
            for event in self.events
            if event["name"] == "EventDispatch" and event["args"]["data"]["type"] in kinds
        ]

    def work_ms(self, names: frozenset[str] = WORK) -> list[tuple[float, float]]:
        """Returns start and duration in ms of each piece of this work, without nested pieces.

        It is the thread's own time if the browser measured it: other processes on its core do not count.
        """
        spans = []
        end = 0.0
        for event in self.events:
            if event["name"] not in names or event["ts"] < end:
                continue
            end = event["ts"] + event["dur"]
            own: float = event["tdur"] if "tdur" in event else event["dur"]
            spans.append((event["ts"] / 1000, own / 1000))
        return spans

    def total_ms(self, names: frozenset[str] = WORK) -> float:
        """Returns the total of this work in ms."""
        return sum(duration for _, duration in self.work_ms(names))

    def to_paint_ms(self, kinds: frozenset[str]) -> float:
        """Returns work and paint from the first of these inputs to the first picture after the last one."""
        begins = self.begins(kinds)
        pictures = (event["ts"] / 1000 for event in self.events if event["name"] in PAINT)
        picture = next((each for each in pictures if each > begins[-1]), math.inf)
        return sum(own for start, own in self.work_ms(WORK | PAINT) if begins[0] <= start <= picture)

    def by_step_ms(self, begins: list[float]) -> list[float]:
        """Returns the work between each input and the next."""
        sums = [0.0] * len(begins)
        at = -1
        for start, duration in self.work_ms():
            while at + 1 < len(begins) and begins[at + 1] <= start + duration:
                at += 1
            if at >= 0:
                sums[at] += duration
        return sums


@contextmanager
def traced(cdp: CDPSession) -> Iterator[Trace]:
    """Records while the block runs; the trace is filled when it ends."""
    trace = Trace()
    chunks: list[Event] = []
    ended: list[bool] = []
    cdp.on("Tracing.dataCollected", lambda data: chunks.extend(data["value"]))
    cdp.on("Tracing.tracingComplete", lambda _: ended.append(True))
    cdp.send(
        "Tracing.start",
        {"traceConfig": {"includedCategories": CATEGORIES}, "transferMode": "ReportEvents"},
    )
    yield trace
    cdp.send("Tracing.end")
    while not ended:
        cdp.send("Runtime.evaluate", {"expression": "0"})
    trace.events = _of_main_thread(chunks)


def _of_main_thread(chunks: list[Event]) -> list[Event]:
    """Finished events of the one page's main thread, in their order."""
    mains = {
        (event["pid"], event["tid"])
        for event in chunks
        if event["name"] == "thread_name" and event["args"]["name"] == "CrRendererMain"
    }
    by_thread: dict[tuple[int, int], list[Event]] = {main: [] for main in mains}
    for event in chunks:
        if event["ph"] == "X" and (event["pid"], event["tid"]) in mains:
            by_thread[event["pid"], event["tid"]].append(event)
    # The browser may keep a spare renderer, which does nearly nothing.
    busiest = max(by_thread.values(), key=len)
    return sorted(busiest, key=lambda event: (event["ts"], -event["dur"]))
