"""The editor in Chromium: the main thread's work for user actions with 100, 600 and 2,000 blocks.

Everything is read from traces of the built front end on the real server. Rasterising is left out: without a
GPU the processor does it, in other threads.
"""

from __future__ import annotations

import argparse
import json
import statistics
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from playwright.sync_api import sync_playwright

from tests.benchmarks import hands
from tests.benchmarks.figures import Figure, show
from tests.benchmarks.renders import count_renders, rendered
from tests.benchmarks.session import Client
from tests.benchmarks.timing import p95
from tests.benchmarks.trace import PAINT, TASK, WORK, traced
from tests.e2e.conftest import CHROMIUM, QUIET, SOFTWARE_WEBGL
from tests.e2e.server import serving
from tests.e2e.studio import NO_FIRST_TASK, NO_LESSONS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from playwright.sync_api import Browser, CDPSession, Locator, Page

    from tests.benchmarks.hands import Gesture

SIZES = (100, 600, 2000)
STEPS = 60
# A frame of a screen lasts 17 ms: so each step of a gesture gets a frame, with time left for later work.
STEP_MS = 40
DROP_ROUNDS = 5
LIVE_BLOCKS = 600
LIVE_S = 10
TASKS = frozenset({TASK})
MOVES = frozenset({"pointermove", "wheel"})
PRESSES = frozenset({"keydown", "click"})
DROPS = frozenset({"pointerup"})
TEMPLATE = "laser_bump_and_go"


def measure(options: Sequence[str] = ()) -> Iterable[Figure]:
    """Yields every figure; `--sizes 600` leaves the other sizes out."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sizes", type=int, nargs="*", default=SIZES)
    chosen = parser.parse_args(options)
    with served_browser() as (browser, client):
        for size in chosen.sizes:
            yield from handling(browser, client, size)
        yield from live(browser, client)


def main() -> None:
    """Prints the figures."""
    show(measure(sys.argv[1:]))


@contextmanager
def served_browser() -> Iterator[tuple[Browser, Client]]:
    """Starts a server with no projects, a client of it and Chromium."""
    with (
        tempfile.TemporaryDirectory() as folder,
        serving(Path(folder)) as server,
        sync_playwright() as started,
        started.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *SOFTWARE_WEBGL]) as browser,
    ):
        yield browser, Client(server)


def wide_tree(count: int) -> dict[str, Any]:
    """A tree of `count` blocks: four children each, six levels, leaves with a port."""
    nodes: dict[str, Any] = {}

    def grow(depth: int) -> str:
        name = f"n{len(nodes) + 1}"
        nodes[name] = {}
        children: list[str] = []
        while len(children) < 4 and depth < 6 and len(nodes) < count:
            children.append(grow(depth + 1))
        inner = {"type": ("Fallback", "Sequence")[depth % 2], "name": f"step {name}", "children": children}
        nodes[name] = inner if children else {"type": "Forward", "ports": {"lin_speed": "0.3"}}
        return name

    return diagram(grow(0), nodes)


def busy_tree(groups: int) -> dict[str, Any]:
    """Returns a tree of groups of five blocks: all groups run at once, and change at different times."""
    nodes: dict[str, Any] = {"all": {"type": "Parallel", "children": [f"g{i}" for i in range(groups)]}}
    for i in range(groups):
        nodes[f"g{i}"] = {"type": "Repeat", "ports": {"num_cycles": "-1"}, "children": [f"g{i}s"]}
        nodes[f"g{i}s"] = {"type": "Sequence", "children": [f"g{i}a", f"g{i}b", f"g{i}c"]}
        for leaf in "abc":
            msec = str(300 + (i * 37 + ord(leaf) * 71) % 500)
            nodes[f"g{i}{leaf}"] = {"type": "Sleep", "ports": {"msec": msec}}
    return diagram("all", nodes)


def diagram(root: str, nodes: dict[str, Any]) -> dict[str, Any]:
    """A main tree of these blocks."""
    head = {"format": "bt-studio/diagram", "version": 1, "id": "MainTree"}
    return {**head, "root": root, "nodes": nodes, "drafts": [], "layout": "vertical"}


def new_project(client: Client, tree: dict[str, Any]) -> str:
    """Makes a project from the template, with this tree as its main tree."""
    project = client.call("POST", "/projects", {"template": TEMPLATE})
    path = f"trees/{tree['id']}.json"
    revision = next(file["revision"] for file in project["files"] if file["path"] == path)
    change = {"path": path, "base_revision": revision, "content": json.dumps(tree)}
    client.call("POST", f"/projects/{project['id']}/changes", {"message": "benchmark", "files": [change]})
    return str(project["id"])


@contextmanager
def page_of(browser: Browser, client: Client, *, counts: bool = False) -> Iterator[Page]:
    """The start page in a fresh profile; `counts` counts rendered blocks, which slows rendering down."""
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    context.set_default_timeout(120_000)
    # A panel beside the canvas would make it narrower, and its tools one button.
    context.add_init_script(NO_LESSONS)
    context.add_init_script(NO_FIRST_TASK)
    if counts:
        count_renders(context)
    page = context.new_page()
    page.goto(client.server.url)
    page.get_by_test_id("project-card").first.wait_for()
    yield page
    context.close()


def open_project(page: Page, client: Client, project: str) -> Locator:
    """Opens a project and waits until its tree is drawn."""
    page.goto(f"{client.server.origin}/projects/{project}")
    canvas = page.get_by_test_id("canvas")
    canvas.locator("[data-type=Forward], [data-type=Sleep]").first.wait_for()
    # Waits for work that is done later: panels that load late, the check, the first autosave.
    page.wait_for_timeout(2000)
    page.evaluate("() => new Promise((done) => requestIdleCallback(done))")
    return canvas


def handling(browser: Browser, client: Client, size: int) -> Iterable[Figure]:
    """Opens a tree, pans, drags, and uses the keyboard."""
    project = new_project(client, wide_tree(size))
    with page_of(browser, client) as page:
        cdp = page.context.new_cdp_session(page)
        with traced(cdp) as trace:
            canvas = open_project(page, client, project)
        yield Figure(f"{size} blocks: opening, main thread", trace.total_ms(TASKS), "ms")
        yield from frames(page, cdp, canvas, f"{size} blocks, as opened")
        hands.read_at_full_size(page, canvas)
        yield from frames(page, cdp, canvas, f"{size} blocks, at 100 %")
        yield from drops(page, cdp, canvas, size)
        yield from interactions(page, cdp, canvas, size)
    with page_of(browser, client, counts=True) as page:
        canvas = open_project(page, client, project)
        for gesture in (hands.pan, hands.drag):
            blocks, frames_ = most_renders(page, canvas, gesture)
            what = f"{size} blocks: a step of a {gesture.__name__} renders at most"
            yield Figure(f"{what} blocks", blocks, "")
            yield Figure(f"{what} frames of blocks", frames_, "")


def frames(page: Page, cdp: CDPSession, canvas: Locator, what: str) -> Iterable[Figure]:
    """Measures script, style and layout for each step of a gesture."""
    yield Figure(f"{what}: seen", canvas.locator(".react-flow__node").count(), "")
    for gesture in (hands.pan, hands.drag):
        with traced(cdp) as trace:
            for _ in gesture(page, canvas, STEPS):
                page.wait_for_timeout(STEP_MS)
        steps = trace.by_step_ms(trace.begins(MOVES))
        yield Figure(f"{what}: a frame of a {gesture.__name__}, median", statistics.median(steps), "ms")
        yield Figure(f"{what}: a frame of a {gesture.__name__}, p95", p95(steps), "ms")


def most_renders(page: Page, canvas: Locator, gesture: Gesture) -> tuple[int, int]:
    """Returns the blocks, and React Flow's frames around them, that render in the worst step."""
    most = (0, 0)
    for step, _ in enumerate(gesture(page, canvas, STEPS // 2)):
        page.wait_for_timeout(STEP_MS)
        blocks, around = rendered(page)
        if step > 0:
            most = (max(most[0], len(blocks)), max(most[1], len(around)))
    return most


def interactions(page: Page, cdp: CDPSession, canvas: Locator, size: int) -> Iterable[Figure]:
    """Measures from the key or button to the next picture, and with all later work: draft, save, answer."""
    slowest: dict[str, tuple[float, float]] = {}
    keys = hands.use_keys(page, canvas)
    while True:
        with traced(cdp) as trace:
            name = next(keys, None)
        if name is None:
            break
        figures = (trace.to_paint_ms(PRESSES), trace.total_ms(WORK | PAINT))
        slowest[name] = max(slowest.get(name, (0.0, 0.0)), figures)
    for name, (paint, total) in slowest.items():
        yield Figure(f"{size} blocks: {name}, to the paint", paint, "ms")
        yield Figure(f"{size} blocks: {name}, with all after", total, "ms")


def drops(page: Page, cdp: CDPSession, canvas: Locator, size: int) -> Iterable[Figure]:
    """From letting a block go to its picture at the new place: by the clock, and in main-thread work."""
    clock: list[float] = []
    work: list[float] = []
    for _ in range(DROP_ROUNDS):
        steps = hands.drop(page, canvas)
        while next(steps, None):
            with traced(cdp) as trace:
                next(steps)
            clock.append(page.evaluate("window.dropped"))
            work.append(trace.to_paint_ms(DROPS))
    for how, times in (("by the clock", clock), ("main thread", work)):
        what = f"{size} blocks: from the drop to the painted block, {how}"
        yield Figure(f"{what}, median", statistics.median(times), "ms")
        yield Figure(f"{what}, worst", max(times), "ms")


def live(browser: Browser, client: Client) -> Iterable[Figure]:
    """Runs 601 blocks at 20 Hz in the simulator, without the 3D view, and measures the canvas."""
    project = new_project(client, busy_tree(LIVE_BLOCKS // 5))
    for counts in (False, True):
        with page_of(browser, client, counts=counts) as page:
            ticks = ticks_of(page)
            open_project(page, client, project)
            page.get_by_role("tab", name="Camera", exact=True).click()
            page.get_by_test_id("run").click()
            page.locator("[data-testid=executor-state][data-state=application_running]").wait_for()
            page.wait_for_timeout(3000)
            ticks.clear()
            yield from (count_live if counts else weigh_live)(page, ticks)
            page.get_by_test_id("end-session").click()
            page.wait_for_timeout(2000)


def ticks_of(page: Page) -> list[dict[str, Any]]:
    """Returns a list that receives every tick that the session sends to this page."""
    ticks: list[dict[str, Any]] = []

    def note(text: str | bytes) -> None:
        if isinstance(text, str) and (message := json.loads(text)).get("command") == "tick":
            ticks.append(message["data"])

    page.on("websocket", lambda socket: socket.on("framereceived", note))
    return ticks


def weigh_live(page: Page, ticks: list[dict[str, Any]]) -> Iterable[Figure]:
    """The main thread's share of a core."""
    cdp = page.context.new_cdp_session(page)
    for what in ("as opened", "all in view"):
        if what == "all in view":
            see_all(page)
        yield Figure(f"live, {what}: seen", page.locator(".react-flow__node").count(), "")
        ticks.clear()
        started = time.monotonic()
        with traced(cdp) as trace:
            page.wait_for_timeout(1000 * LIVE_S)
            lasted = 1000 * (time.monotonic() - started)
        changes = statistics.mean(len(tick["changed"]) for tick in ticks)
        figures = {"script, style, layout": trace.total_ms(), "the whole main thread": trace.total_ms(TASKS)}
        yield Figure(f"live, {what}: ticks", 1000 * len(ticks) / lasted, "/s", "higher")
        yield Figure(f"live, {what}: of {LIVE_BLOCKS} blocks change a tick", changes, "")
        for name, ms in figures.items():
            yield Figure(f"live, {what}: {name}, of a core", 100 * ms / lasted, "%")


def see_all(page: Page) -> None:
    """Zooms out until the whole tree is in view, or as far as possible."""
    for _ in range(8):
        page.get_by_role("button", name="Zoom out").click()
        page.wait_for_timeout(200)
    page.wait_for_timeout(hands.SETTLED_MS)


def count_live(page: Page, ticks: list[dict[str, Any]]) -> Iterable[Figure]:
    """Counts the rendered blocks, and the blocks that changed according to the session."""
    see_all(page)
    rendered(page)
    ticks.clear()
    page.wait_for_timeout(1000 * LIVE_S)
    blocks, _ = rendered(page)
    named = sum(len({uid for uid, _ in tick["changed"] + tick["flashed"]}) for tick in ticks)
    yield Figure("live: blocks that a tick names", named / len(ticks), "")
    yield Figure("live: blocks that a tick renders", len(blocks) / len(ticks), "")


if __name__ == "__main__":
    main()
