"""A tree of six hundred blocks on one screen: names, pieces, statuses, search, the past, and ways into it."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.canvas_by_hand import paste
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(300)]

ZONES = 25
WAITS = 22
BLOCKS = 1 + ZONES * (2 + WAITS)
LEAST_PX = 10
# What the picture tells of its names: level and size in px, and how many blocks the pieces hold.
SEEN = """root => ({
  names: [...root.querySelectorAll('[data-part]')].map((part) => [
    Number(part.getAttribute('aria-level')),
    parseFloat(getComputedStyle(part.firstElementChild).fontSize),
  ]),
  below: [...root.querySelectorAll('[data-piece]')]
    .reduce((sum, piece) => sum + Number(piece.dataset.piece), 0),
})"""


def test_the_whole_of_a_large_tree(studio_without_views: Studio) -> None:
    studio = studio_without_views
    six_hundred_blocks(studio)
    names_and_pieces_are_seen_at_once(studio)
    a_search_marks_pieces_and_enter_goes_there(studio)
    keys_and_presses_lead_into_it(studio)
    it_shows_the_run(studio)
    it_shows_the_past(studio)


def six_hundred_blocks(studio: Studio) -> None:
    studio.at("new-from-empty").click()
    expect(studio.at("canvas")).to_be_focused()
    waits = "".join(f'<Sleep name="wait {at}" msec="400"/>' for at in range(WAITS))
    zone = (
        '<Repeat name="zone {0}" num_cycles="-1"><Sequence name="shelves {0}">'
        + waits
        + "</Sequence></Repeat>"
    )
    paste(studio, f'<Parallel name="mission">{"".join(zone.format(at) for at in range(ZONES))}</Parallel>')
    expect(studio.at("canvas").locator("[data-type=Parallel]")).to_have_count(1)
    studio.saved()


def names_and_pieces_are_seen_at_once(studio: Studio) -> None:
    studio.page.keyboard.press("Shift+Digit1")
    whole = studio.at("whole-tree")
    expect(whole.get_by_role("status")).to_contain_text(f"{BLOCKS} blocks")
    seen = whole.evaluate(SEEN)
    upper = [px for level, px in seen["names"] if level <= 3]
    assert len(upper) == 1 + 2 * ZONES, "the upper three levels have names"
    assert min(upper) >= LEAST_PX
    assert len(seen["names"]) + seen["below"] == BLOCKS, "each block is a name, or in one piece"
    for scheme in ("dark", "light"):
        studio.page.evaluate(
            "s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme
        )
        expect_no_findings(studio.page, f"the whole tree, {scheme}", "[data-testid=whole-tree]")
        studio.picture(f"whole-tree-{scheme}")


def a_search_marks_pieces_and_enter_goes_there(studio: Studio) -> None:
    keys, whole = studio.page.keyboard, studio.at("whole-tree")
    keys.press("Control+f")
    studio.writing()
    keys.type("wait 7")
    expect(whole.locator("[data-piece][data-found]")).to_have_count(ZONES)
    keys.press("Enter")
    expect(whole).to_have_count(0)
    expect(studio.at("canvas").locator("[data-selected]")).to_contain_text("wait 7")
    keys.press("Escape")


def keys_and_presses_lead_into_it(studio: Studio) -> None:
    keys, canvas, whole = studio.page.keyboard, studio.at("canvas"), studio.at("whole-tree")
    keys.press("Shift+Digit1")
    expect(whole.locator("[data-piece][data-chosen]")).to_have_count(1)
    for key in ("Home", "ArrowDown", "ArrowRight"):
        keys.press(key)
    expect(whole.locator("[data-part][data-chosen]")).to_contain_text("zone 1")
    keys.press("Enter")
    expect(whole).to_have_count(0)
    expect(canvas.locator("[data-selected]")).to_contain_text("zone 1")
    expect(canvas).to_be_focused()
    keys.press("Shift+Digit1")
    part_of(whole, "shelves 9").click(position={"x": 20, "y": 6})
    expect(whole).to_have_count(0)
    expect(canvas.locator("[data-selected]")).to_contain_text("shelves 9")
    expect(canvas).to_be_focused()


def part_of(whole: Locator, name: str) -> Locator:
    return whole.get_by_role("treeitem", name=re.compile(rf"^{name}(\s|$)"))


def it_shows_the_run(studio: Studio) -> None:
    studio.run()
    studio.at("canvas").focus()
    studio.page.keyboard.press("Shift+Digit1")
    whole = studio.at("whole-tree")
    expect(part_of(whole, "mission")).to_have_attribute("data-status", "RUNNING")
    expect(whole.locator("[data-piece][data-status=RUNNING]")).to_have_count(ZONES)
    studio.picture("whole-tree-running")


def it_shows_the_past(studio: Studio) -> None:
    """As it ran, in a tab of its own; then the present again."""
    wait_until(lambda: studio.stat("t") > 2, "there is a past to look at")
    studio.at("pause").click()
    studio.expect_state("paused")
    studio.at("axis-strip").click(position={"x": 60, "y": 8})
    past = studio.at("recorded-canvas").get_by_test_id("whole-tree")
    expect(past.locator("[data-piece][data-status=RUNNING]")).to_have_count(ZONES)
    assert past.evaluate(SEEN)["below"] > 0
    studio.picture("whole-tree-past")
    part_of(past, "shelves 3").click(position={"x": 20, "y": 6})
    expect(past).to_have_count(0)
    studio.page.keyboard.press("Escape")
    expect(studio.at("time-axis")).not_to_have_attribute("data-past", "true")
    studio.end_session()
