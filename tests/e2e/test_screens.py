"""Every screen of the IDE in both themes: nothing that keeps somebody from using it; a picture to look at."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.budget import count
from tests.e2e.accessibility import expect_accessible

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
PANELS = ("Timeline", "Topics", "Problems", "Blackboard", "Library", "Outline", "Camera")


def screens(studio: Studio) -> Iterator[str]:
    """Opens one after the other."""
    page = studio.page
    yield "running"
    studio.at("pause").click()  # what stands still is drawn sooner
    studio.expect_state("paused")
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
    page.get_by_role("tab", name="Explorer", exact=True).click()
    studio.open_file("actions/Forward.py")
    yield "code"
    page.get_by_role("tab", name="MainTree", exact=True).click()
    studio.at("node-n5").click()
    yield "selected"


@pytest.mark.parametrize("scheme", ["dark", "light"][: count("e2e_screen_themes")])
def test_every_screen_can_be_used_by_everybody(studio: Studio, scheme: str) -> None:
    studio.new_from("laser_bump_and_go")
    studio.run()
    for name in screens(studio):
        expect_accessible(studio, scheme)
        studio.picture(f"screen-{name}-{scheme}")
    studio.end_session()
