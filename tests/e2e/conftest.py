"""A real server and a real browser for all tests of this folder; each has a browser context to itself."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import Browser, Page, expect, sync_playwright

from tests.budget import count
from tests.e2e.panels import VIEWS_BEHIND
from tests.e2e.reset import Reset
from tests.e2e.server import Server, serving
from tests.e2e.studio import WAIT_MSEC, Studio

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from playwright.sync_api import Playwright

CHROMIUM = "/usr/bin/chromium"
QUIET = [
    "--no-sandbox",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
]
# WebGL is emulated. Chromium with `--use-angle` alone would draw the whole page by the emulation, which takes
# most of a walk's time; where there is no GPU, a user's browser puts the page together by the processor.
SOFTWARE_WEBGL = [
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-gpu-rasterization",
    "--disable-gpu-compositing",
]
NO_WEBGL = ["--disable-gpu", "--disable-3d-apis"]

# The page's speed is not under test: a busy machine must not fail these tests.
expect.set_options(timeout=WAIT_MSEC)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leaves the longest walks to `make test-full`, and to `-m long_walk`."""
    if count("e2e_long_walks") or "long_walk" in config.option.markexpr:
        return
    long = [item for item in items if item.get_closest_marker("long_walk")]
    config.hook.pytest_deselected(items=long)
    items[:] = [item for item in items if item not in long]


@pytest.fixture(scope="session")
def playwright() -> Iterator[Playwright]:
    with sync_playwright() as playwright:
        yield playwright


@pytest.fixture(scope="session")
def browser(playwright: Playwright) -> Iterator[Browser]:
    browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *SOFTWARE_WEBGL])
    yield browser
    browser.close()


@pytest.fixture(scope="session")
def browser_without_webgl(playwright: Playwright) -> Iterator[Browser]:
    browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *NO_WEBGL])
    yield browser
    browser.close()


@pytest.fixture(scope="session")
def warm_server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    with serving(tmp_path_factory.mktemp("warm")) as server:
        yield server


@pytest.fixture(scope="session")
def reset(playwright: Playwright, warm_server: Server) -> Iterator[Reset]:
    reset = Reset(playwright, warm_server)
    yield reset
    reset.close()


@pytest.fixture
def server(warm_server: Server, reset: Reset) -> Iterator[Server]:
    """One server for all tests that neither end it nor need settings; each finds no project and no run."""
    yield warm_server
    reset.start_over()


@pytest.fixture
def open_studio(server: Server) -> Iterator[Callable[[Browser], Studio]]:
    """Opens the IDE in a browser; at the end, the page's console must be empty."""
    opened: list[Studio] = []

    def open_in(browser: Browser) -> Studio:
        page: Page = browser.new_context(viewport={"width": 1440, "height": 900}).new_page()
        studio = Studio(page, server)
        opened.append(studio)
        studio.open()
        return studio

    yield open_in
    for studio in opened:
        studio.page.context.close()
        assert studio.complaints == [], "the browser's console must stay empty, and nothing is refused"


@pytest.fixture
def studio_without_views(server: Server, browser_without_webgl: Browser) -> Iterator[Studio]:
    """A page for walks that do not look at the world: its views are behind the inspector."""
    context = browser_without_webgl.new_context(viewport={"width": 1440, "height": 900})
    context.add_init_script(VIEWS_BEHIND)
    studio = Studio(context.new_page(), server)
    studio.open()
    yield studio
    context.close()
    assert studio.complaints == [], "the browser's console must stay empty, and nothing is refused"


@pytest.fixture
def studio(open_studio: Callable[[Browser], Studio], browser: Browser) -> Studio:
    return open_studio(browser)
