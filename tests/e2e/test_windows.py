"""Every panel of the run in a window of its own, and the end of all windows with the page."""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

if TYPE_CHECKING:
    from playwright.sync_api import Page

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(300)]

# What lives in each panel: Video before 3D, beside which it would rest.
PANELS = {
    "Video": "[data-testid=view-figures]",
    "3D": "[data-testid=viewer-3d] canvas",
    "Camera": "[data-testid=camera-figures]",
    "Console": "[data-testid=console] [role=log]",
    "Timeline": "[data-testid=timeline] [role=button], [data-testid=timeline] button",
    "Topics": "[data-testid='topic-/odom']",
    "Blackboard": "[data-testid=blackboard] tbody tr",
}


@pytest.mark.long_walk
def test_every_panel_has_a_window_and_all_go_with_the_page(studio: Studio) -> None:
    studio.new_from("visual_follow_person")
    studio.run()
    windows = {name: opened(studio, name) for name in PANELS}
    for name, window in windows.items():
        expect(window.locator(PANELS[name]).first).to_be_visible()
        expect(window).to_have_title(f"{name} — BT Studio")
        expect(studio.page.get_by_role("tab", name=name, exact=True)).to_have_count(0)
    studio.picture("all-panels-out")
    keys_and_fields_work_in_a_window(studio, windows)
    a_panel_returns_to_its_place(studio, windows.pop("Timeline"))
    all_of_them_speak_spanish(studio, windows)
    studio.end_session()
    with ExitStack() as ends:
        for window in windows.values():
            ends.enter_context(window.expect_event("close"))
        studio.page.close(run_before_unload=True)


def opened(studio: Studio, name: str) -> Page:
    """Presses the button that opens a panel in a window; returns the window."""
    tab = studio.page.get_by_role("tab", name=name, exact=True)
    tab.click()
    bar = studio.page.locator(".flexlayout__tabset_tabbar_outer").filter(has=tab)
    with studio.page.expect_popup() as popup:
        bar.get_by_role("button", name="Open in a window of its own").click()
    window = popup.value
    window.on("console", studio._note)
    window.on("pageerror", lambda error: studio.complaints.append(str(error)))
    return window


def keys_and_fields_work_in_a_window(studio: Studio, windows: dict[str, Page]) -> None:
    """A search in one window, and the keys of the run in another."""
    console, board = windows["Console"], windows["Blackboard"]
    console.get_by_role("searchbox").fill("nothing prints this")
    expect(console.get_by_text("No line matches the filter.")).to_be_visible()
    console.get_by_role("searchbox").fill("")
    board.bring_to_front()
    board.locator("body").press("F6")
    studio.expect_state("paused")
    expect(board.locator("tbody input").first).to_be_visible()
    board.locator("body").press("F7")
    studio.expect_state("application_running")
    expect(board.locator("tbody input")).to_have_count(0)


def a_panel_returns_to_its_place(studio: Studio, window: Page) -> None:
    window.evaluate("window.close()")
    expect(studio.page.get_by_role("tab", name="Timeline", exact=True)).to_be_visible()


def all_of_them_speak_spanish(studio: Studio, windows: dict[str, Page]) -> None:
    studio.page.bring_to_front()
    studio.command("spanish")
    expect(windows["Blackboard"].get_by_role("columnheader", name="Clave").first).to_be_visible()
    studio.command("inglés")
