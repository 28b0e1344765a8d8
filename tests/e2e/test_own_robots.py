"""A robot that waits for a place: the page says its turn, and ends another robot of the same user."""

from __future__ import annotations

from typing import TYPE_CHECKING

from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.server import serving
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser, ViewportSize

WIDE: ViewportSize = {"width": 1440, "height": 900}
NARROW: ViewportSize = {"width": 400, "height": 800}
MOST_KEYS = 60


def test_a_robot_that_waits_gets_the_place_of_another_one_by_keys(
    tmp_path: Path, browser_without_webgl: Browser
) -> None:
    with serving(tmp_path, BT_STUDIO_MAX_SESSIONS="1") as server:
        context = browser_without_webgl.new_context(viewport=WIDE)
        first = Studio(context.new_page(), server)
        first.open()
        first.new_from("laser_bump_and_go")
        first.run()
        second = Studio(context.new_page(), server)
        second.open()
        second.new_from("laser_bump_and_go")
        waits(second)
        ends_the_other_by_keys(second)
        second.expect_state("application_running")
        expect(first.at("banner")).to_contain_text("The session has ended.")
        second.end_session()
        context.close()
        assert second.complaints == [], "the browser's console must stay empty"


def waits(studio: Studio) -> None:
    """It says what it waits for, in both themes and in a narrow window."""
    studio.page.keyboard.press("F5")
    progress = studio.at("run-progress")
    expect(progress).to_contain_text("Waiting: you are next")
    for scheme in ("light", "dark"):
        studio.page.evaluate(
            "scheme => { document.documentElement.dataset.mantineColorScheme = scheme }", scheme
        )
        expect_no_findings(studio.page, f"a robot waits, {scheme}")
        studio.picture(f"waiting_{scheme}")
    studio.page.set_viewport_size(NARROW)
    for name in ("Your robots…", "Cancel"):
        button = progress.get_by_role("button", name=name)
        expect(button).to_be_in_viewport(ratio=1)
    turn = progress.get_by_text("Waiting: you are next", exact=True)
    assert turn.evaluate("text => text.scrollWidth <= text.clientWidth"), "the turn is cut off"
    studio.picture("waiting_narrow")


def ends_the_other_by_keys(studio: Studio) -> None:
    """The list of robots is opened, read and used without a mouse."""
    page = studio.page
    button = studio.at("run-progress").get_by_role("button", name="Your robots…")
    for _ in range(MOST_KEYS):  # the canvas takes the focus in a new width, until Tab is pressed
        page.keyboard.press("Shift+Tab")
        if button.evaluate("button => button === document.activeElement"):
            break
    page.keyboard.press("Enter")
    robots = studio.at("own-robots").get_by_role("listitem")
    expect(robots).to_have_count(2)
    expect(robots.nth(0)).to_contain_text("runs")
    expect(robots.nth(1)).to_contain_text("this project")
    expect(robots.nth(1)).to_contain_text("waits")
    for scheme in ("light", "dark"):
        page.evaluate("scheme => { document.documentElement.dataset.mantineColorScheme = scheme }", scheme)
        expect_no_findings(page, f"own robots, {scheme}")
        studio.picture(f"own_robots_{scheme}")
    beyond = page.evaluate("document.documentElement.scrollWidth - innerWidth")
    assert beyond <= 0, "the list is too wide for a narrow window"
    page.keyboard.press("Tab")
    ends = page.locator(":focus")
    expect(ends).to_contain_text("End")
    page.keyboard.press("Enter")
    expect(robots).to_have_count(1)
    page.keyboard.press("Escape")
    expect(studio.at("own-robots")).to_have_count(0)
    page.set_viewport_size(WIDE)
