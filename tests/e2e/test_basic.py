"""The basic page of a new browser: calm, and everything else one step away."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.controls import visible_controls
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator

    from tests.e2e.server import Server

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]
MOST_CONTROLS = 45
TABS = [
    *("Nodes", "MainTree", "Console", "Problems"),
    *("3D", "Video", "Inspector"),
]


def test_a_first_project_shows_what_it_needs_and_the_rest_when_it_is_used(
    server: Server, browser_without_webgl: Browser
) -> None:
    context = browser_without_webgl.new_context(viewport={"width": 1440, "height": 900})
    studio = Studio(context.new_page(), server, is_basic=True)
    studio.open()
    expect(studio.at("theme-toggle")).to_be_visible()  # only a project has the menu in which it would be
    studio.new_from("laser_bump_and_go")
    it_is_calm_while_it_runs(studio)
    a_block_tells_why_first(studio)
    a_panel_opens_when_it_is_used(studio)
    everything_is_one_click_away_and_documents_stay(studio)
    context.close()
    assert studio.complaints == []


def tabs(studio: Studio) -> Locator:
    return studio.page.get_by_role("tab")


def it_is_calm_while_it_runs(studio: Studio) -> None:
    expect(tabs(studio)).to_have_text(TABS)
    studio.run()
    expect(studio.at("time-axis")).to_be_visible()
    found = visible_controls(studio.page)
    assert len(found) <= MOST_CONTROLS, found
    for scheme in ("dark", "light"):
        expect_accessible(studio, scheme)
        studio.picture(f"basic-{scheme}")


def a_block_tells_why_first(studio: Studio) -> None:
    expect(studio.at("step")).to_have_count(0)
    studio.at("pause").click()
    studio.expect_state("paused")
    expect(studio.at("step")).to_be_visible()
    studio.at("node-n1").click()
    expect(studio.at("why")).to_have_attribute("open", "")
    expect(studio.at("debug-section")).to_have_count(0)
    studio.page.keyboard.press("F9")
    expect(studio.at("debug-section")).to_be_visible()
    studio.page.keyboard.press("F9")
    expect(studio.at("debug-section")).to_have_count(0)
    studio.at("inspector-more").locator("summary").first.press("Enter")
    expect(studio.at("debug-section")).to_be_visible()


def a_panel_opens_when_it_is_used(studio: Studio) -> None:
    page = studio.page
    page.keyboard.press("Control+Shift+H")
    expect(page.get_by_role("tab", name="History", exact=True)).to_have_attribute("aria-selected", "true")
    studio.command("Timeline")
    expect(studio.at("timeline")).to_be_visible()
    page.get_by_role("tab", name="Nodes", exact=True).click()
    studio.at("palette").get_by_role("button", name="More blocks…").click()
    expect(studio.at("palette-Parallel")).to_be_visible()


def everything_is_one_click_away_and_documents_stay(studio: Studio) -> None:
    page = studio.page
    studio.at("node-n5").dblclick()
    expect(studio.at("code-editor")).to_be_visible()
    studio.at("view-mode").click()
    expect(page.get_by_role("tab", name="Explorer", exact=True)).to_be_visible()
    expect(studio.at("code-editor")).to_be_visible()
    expect(studio.at("end-session")).to_be_visible()
    page.set_viewport_size({"width": 390, "height": 844})
    studio.at("view-mode").click()
    expect(page.get_by_role("tab", name="Evaluate", exact=True)).to_have_count(0)
    studio.picture("basic-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    page.reload()
    expect(studio.at("view-mode")).to_have_attribute("data-mode", "basic")
    expect(page.get_by_role("tab", name="Timeline", exact=True)).to_be_visible()
    studio.expect_state("paused")
    studio.end_session()
