"""The panel *Evaluate* with 2,000 runs in Chromium: the main thread's work as it opens, is used, and fills.

The answers about evaluations come from here, so that the figures are those of the page alone.
"""

from __future__ import annotations

import json
import statistics
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qs, urlsplit

import numpy as np

from tests.benchmarks.browser import TASKS, TEMPLATE, open_project, page_of, served_browser
from tests.benchmarks.timing import p95
from tests.benchmarks.trace import traced

if TYPE_CHECKING:
    from playwright.sync_api import Page, Route

RUNS = 2000
KEYS = 60
LIVE_S = 20
A_SECOND = 20
"""Outcomes that come in a second; two cores make some three."""
ID = "0b0e8f0a-5b0c-4b57-9f0a-000000000001"
MEASURES = ("path_length_m", "smallest_clearance_m", "mean_speed_m_s", "energy_j")
KEY_DOWN = frozenset({"keydown"})


@dataclass
class Server:
    """Answers about one evaluation of which `done` runs have come to an end."""

    done: int

    def answer(self, route: Route) -> None:
        """Answers a request of the page."""
        url = urlsplit(route.request.url)
        if url.path.endswith("/outcomes"):
            after = int(parse_qs(url.query)["after"][0])
            items = [outcome(seed) for seed in range(after, self.done)]
            body: dict[str, Any] = {"items": items, "cursor": self.done}
        else:
            body = {"items": [self.evaluation()], "costs": [], "may_start": True, "may_replay": True}
            body["why_not"] = ""
        route.fulfill(status=200, content_type="application/json", body=json.dumps(body))

    def evaluation(self) -> dict[str, Any]:
        """Returns the evaluation as the server tells it."""
        is_live = self.done < RUNS
        counts = {"success": self.done - self.done // 10, "failure": self.done // 10}
        side = {"revision": 3, "done": self.done, "wanted": RUNS, "rate": 0.9, "low": 0.88, "high": 0.92}
        return {
            "id": ID, "name": "room", "revision": 3, "older": None, "seed": 0, "sequential": False,
            "sealed": False, "duration_s": 60.0, "workers": 2, "state": "running" if is_live else "done",
            "waits_for": "", "error": "", "attempt": 1, "left_s": 60.0 if is_live else None, "author": "ada",
            "created_at": "2026-01-01T10:00:00Z", "ended_at": None if is_live else "2026-01-01T11:00:00Z",
            "sides": [{**side, "counts": counts}],
        }  # fmt: skip


def outcome(seed: int) -> dict[str, Any]:
    """Returns the outcome of a seed; each tenth has failed."""
    draw = np.random.default_rng(seed)
    measures = {name: round(float(draw.uniform(0, 10)), 6) for name in MEASURES}
    failed = seed % 10 == 9
    margin = round(float(draw.uniform(-0.1, 0)), 6) if failed else 0.3
    return {
        "seed": seed, "outcome": "failure" if failed else "success",
        "why": "never collision" if failed else "all items hold", "end_s": 60.0,
        "margin": margin, "unit": "m", "measures": measures,
    }  # fmt: skip


def main() -> None:
    """Prints every figure."""
    with served_browser() as (browser, client):
        project = str(client.call("POST", "/projects", {"template": TEMPLATE})["id"])
        with page_of(browser, client) as page:
            server = Server(RUNS)
            page.route("**/api/v1/projects/*/evaluations**", server.answer)
            page.route("**/api/v1/projects/*/evaluations/**", server.answer)
            open_project(page, client, project)
            opened(page)
            used(page)
            fills(page, server)


def opened(page: Page) -> None:
    """The work until all cells are drawn."""
    with traced(page.context.new_cdp_session(page)) as trace:
        page.get_by_role("tab", name="Evaluate", exact=True).click()
        page.get_by_test_id("evaluate").get_by_text(f"{RUNS} of {RUNS} runs").wait_for()
        page.get_by_test_id("evaluation-grid").wait_for()
        page.wait_for_timeout(1000)
    longest = max(duration for _, duration in trace.work_ms(TASKS))
    print(f"{RUNS} cells: opening takes {trace.total_ms(TASKS):.0f} ms, the longest task {longest:.0f} ms")


def used(page: Page) -> None:
    """The work of an arrow key, which moves the chosen cell."""
    page.get_by_role("slider", name="Runs by seed").focus()
    with traced(page.context.new_cdp_session(page)) as trace:
        for _ in range(KEYS):
            page.keyboard.press("ArrowRight")
            page.wait_for_timeout(40)
    steps = trace.by_step_ms(trace.begins(KEY_DOWN))
    print(f"{RUNS} cells: a key takes {statistics.median(steps):.1f} ms, p95 {p95(steps):.1f} ms")


def fills(page: Page, server: Server) -> None:
    """The work while further outcomes come each second, from half of them on."""
    server.done = RUNS // 2
    page.reload()
    page.get_by_role("tab", name="Evaluate", exact=True).click()
    page.get_by_test_id("evaluate").get_by_text(f"{server.done} of {RUNS} runs").wait_for()
    page.wait_for_timeout(3000)
    with traced(page.context.new_cdp_session(page)) as trace:
        for _ in range(LIVE_S):
            server.done += A_SECOND
            page.wait_for_timeout(1000)
    spans = trace.work_ms(TASKS)
    longest = max(duration for _, duration in spans)
    share = trace.total_ms(TASKS) / LIVE_S / 1000
    print(f"{RUNS} cells, filling: {share:.1%} of the main thread, the longest task {longest:.0f} ms")


if __name__ == "__main__":
    main()
