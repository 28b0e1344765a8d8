"""Every screen of the IDE in both themes: accessible, with a picture for inspection."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.budget import count
from tests.e2e.accessibility import expect_accessible, expect_to_fit

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

DIALOGUES = {
    "worlds": "Control+Shift+KeyU",
    "take-away": "Control+Shift+KeyS",
    "commands": "Control+KeyK",
    "shortcuts": "Control+Slash",
}
PANELS = (
    *("Timeline", "Topics", "Breakpoints", "Profile", "Problems", "Blackboard", "Library", "Outline"),
    *("History", "Nodes", "Search", "Camera"),
)


def screens(studio: Studio) -> Iterator[str]:
    """Opens one after another."""
    page = studio.page
    page.mouse.move(0, 0)  # away from the button, whose tip is no part of the page
    yield "running"
    studio.at("pause").click()  # a paused world is drawn sooner
    studio.expect_state("paused")
    page.keyboard.press("Control+Alt+KeyB")  # these two are hidden until they are used
    page.keyboard.press("Control+Alt+KeyP")
    for name in PANELS:
        page.get_by_role("tab", name=name, exact=True).click()
        yield f"panel-{name.lower()}"
    for name, keys in DIALOGUES.items():
        page.keyboard.press(keys)
        dialogue = page.get_by_role("dialog")
        expect(dialogue).to_be_visible()
        yield name
        page.keyboard.press("Escape")
        expect(dialogue).to_have_count(0)
    for name in ("More", "More ways to run"):
        page.get_by_role("button", name=name, exact=True).click()
        expect(page.get_by_role("menu")).to_be_visible()
        yield f"menu-{name.lower().replace(' ', '-')}"
        page.keyboard.press("Escape")
        expect(page.get_by_role("menu")).to_have_count(0)
    page.get_by_role("tab", name="Explorer", exact=True).click()
    studio.open_file("actions/Forward.py")
    yield "code"
    page.get_by_role("tab", name="MainTree", exact=True).click()
    studio.at("node-n5").click()
    yield "selected"


@pytest.mark.parametrize("scheme", ["dark", "light"][: count("e2e_screen_themes")])
def test_every_screen_can_be_used_by_everybody(studio: Studio, scheme: str) -> None:
    expect_accessible(studio, scheme)
    studio.new_from("laser_bump_and_go")
    studio.run()
    for name in screens(studio):
        expect_accessible(studio, scheme)
        studio.picture(f"screen-{name}-{scheme}")
    everything_is_within_reach_of_a_narrow_window_in_spanish(studio)
    studio.end_session()


def everything_is_within_reach_of_a_narrow_window_in_spanish(studio: Studio) -> None:
    page = studio.page
    page.get_by_role("button", name="More", exact=True).click()
    studio.menu("More").get_by_role("menuitem", name="Español").click()
    page.set_viewport_size({"width": 480, "height": 850})
    tabs = page.locator(".flexlayout__tabset_tabbar_outer").last.get_by_role("tab")
    expect(tabs).to_have_count(17)
    for name in tabs.all_inner_texts():
        tab = tabs.filter(has_text=re.compile(f"^{name}$"))
        tab.evaluate("tab => tab.scrollIntoView()")
        tab.click()
        expect(tab).to_have_attribute("aria-selected", "true")
        expect_to_fit(page, name)
    for name, keys in DIALOGUES.items():
        page.keyboard.press(keys)
        expect(page.get_by_role("dialog")).to_be_visible()
        expect_to_fit(page, name)
        page.keyboard.press("Escape")
        expect(page.get_by_role("dialog")).to_have_count(0)
    studio.picture("narrow-spanish")
