"""The debugger's marks on 600 blocks that run: the main thread's share of a core with and without them.

500 breakpoints, the most that a session takes, are never hit; then all blocks show their share of the time,
too. The rows come in turn, so that they meet the same load of the machine.
"""

from __future__ import annotations

import json
import statistics
import time
from typing import TYPE_CHECKING, Any

from tests.benchmarks.browser import (
    LIVE_BLOCKS,
    TASKS,
    busy_tree,
    new_project,
    open_project,
    page_of,
    see_all,
    served_browser,
)
from tests.benchmarks.trace import traced

if TYPE_CHECKING:
    from playwright.sync_api import Page

ROUNDS = 4
ROUND_S = 5
MOST = 500
KEY = "Object.keys(localStorage).find((key) => key.startsWith('bts.breakpoints.'))"


def main() -> None:
    """Prints the shares."""
    with served_browser() as (browser, client):
        project = new_project(client, busy_tree(LIVE_BLOCKS // 5))
        with page_of(browser, client) as page:
            open_project(page, client, project)
            page.get_by_role("tab", name="Camera", exact=True).click()
            page.get_by_test_id("node-all").click()
            page.keyboard.press("F9")  # so that the list of this user and project is kept
            with_breakpoints(page, client, project, [])
            rows = {name: measured(page, client, project, name) for name in ("none", "breakpoints", "heat")}
    for name, found in rows.items():
        own, whole = (statistics.median(each) for each in zip(*found, strict=True))
        print(
            f"{name:12} script, style, layout {own:5.1f} %, the whole main thread {whole:5.1f} %", flush=True
        )


def measured(page: Page, client: Any, project: str, name: str) -> list[tuple[float, float]]:
    """The shares of a run with these marks, in percent of a core."""
    with_breakpoints(page, client, project, [] if name == "none" else never_hit())
    page.get_by_test_id("run").click()
    page.locator("[data-testid=executor-state][data-state=application_running]").wait_for()
    if name == "heat":
        page.keyboard.press("Control+Alt+KeyP")
        page.get_by_test_id("profile-on").click(force=True)
    see_all(page)
    cdp = page.context.new_cdp_session(page)
    found = []
    for _ in range(ROUNDS):
        started = time.monotonic()
        with traced(cdp) as trace:
            page.wait_for_timeout(1000 * ROUND_S)
            lasted = 1000 * (time.monotonic() - started)
        found.append((100 * trace.total_ms() / lasted, 100 * trace.total_ms(TASKS) / lasted))
    marks = page.locator("[data-testid^=breakpoint-]").count()
    print(f"{name}: {marks} marks seen, {found}", flush=True)
    page.get_by_test_id("end-session").click()
    page.wait_for_timeout(1000)
    return found


def never_hit() -> list[dict[str, Any]]:
    """Breakpoints on blocks, with a condition that is false."""
    nodes = [name for name in busy_tree(LIVE_BLOCKS // 5)["nodes"] if name != "all"][:MOST]
    other = {"instance": None, "when": "before", "status": None, "condition": "false", "hits": 1, "log": ""}
    return [{"tree_id": "MainTree", "node_id": node, **other, "on": True} for node in nodes]


def with_breakpoints(page: Page, client: Any, project: str, breakpoints: list[dict[str, Any]]) -> None:
    """Opens the project with these breakpoints."""
    kept = json.dumps({"list": breakpoints, "areOn": True})
    page.evaluate(f"kept => localStorage.setItem({KEY}, kept)", kept)
    page.goto("about:blank")
    open_project(page, client, project)


if __name__ == "__main__":
    main()
