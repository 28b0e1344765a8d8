"""The page's memory while a tree of 600 blocks runs: `python -m tests.benchmarks.heap --minutes 10`."""

from __future__ import annotations

import argparse
import statistics
import time
from typing import TYPE_CHECKING

from tests.benchmarks.browser import (
    LIVE_BLOCKS,
    busy_tree,
    new_project,
    open_project,
    page_of,
    see_all,
    served_browser,
)

if TYPE_CHECKING:
    from playwright.sync_api import CDPSession, Page

EVERY_S = 20
# Until then code is compiled and buffers fill up that have a size: the console, the timeline, the trail.
SETTLED_S = 120


def main() -> None:
    """Prints each sample, and the growth of the heap after the first two minutes."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0)
    minutes = parser.parse_args().minutes
    with served_browser() as (browser, client):
        project = new_project(client, busy_tree(LIVE_BLOCKS // 5))
        with page_of(browser, client) as page:
            open_project(page, client, project)
            page.get_by_test_id("run").click()
            page.locator("[data-testid=executor-state][data-state=application_running]").wait_for()
            see_all(page)
            slope_of(looks(page, minutes))
            page.get_by_test_id("end-session").click()
            page.wait_for_timeout(2000)


def looks(page: Page, minutes: float) -> list[tuple[float, float]]:
    """Returns times in s, and the used heap in MB after a garbage collection."""
    cdp = page.context.new_cdp_session(page)
    began = time.monotonic()
    found: list[tuple[float, float]] = []
    while (at := time.monotonic() - began) < 60 * minutes:
        used = heap_mb(cdp)
        counts = cdp.send("Memory.getDOMCounters")
        found.append((at, used))
        kept = f"{counts['nodes']} DOM nodes, {counts['jsEventListeners']} listeners"
        print(f"{at:5.0f} s: {used:.2f} MB, {kept}", flush=True)
        page.wait_for_timeout(1000 * EVERY_S)
    return found


def heap_mb(cdp: CDPSession) -> float:
    """Returns the heap of the page's script in MB."""
    cdp.send("HeapProfiler.collectGarbage")
    used: float = cdp.send("Runtime.getHeapUsage")["usedSize"]
    return used / 1e6


def slope_of(found: list[tuple[float, float]]) -> None:
    """Fits a straight line to the samples after the first minutes."""
    settled = [(at, used) for at, used in found if at >= SETTLED_S] or found
    slope = statistics.linear_regression(*zip(*settled, strict=True)).slope
    first, last = settled[0][1], settled[-1][1]
    print(f"{first:.2f} MB, then {last:.2f} MB: {3600 * slope:+.2f} MB an hour")


if __name__ == "__main__":
    main()
