"""From a past moment of an exact run: five values of a port are tried, and the code of a tick is shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


def test_five_values_are_tried_from_a_past_moment(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    page = studio.page
    studio.new_from("laser_bump_and_go")
    studio.command("Time of the next run: exact")
    studio.saved()
    studio.run()
    wait_until(lambda: studio.stat("t") > 5, "the robot drives for a while")
    studio.at("pause").click()
    studio.expect_state("paused")
    studio.at("axis-strip").focus()
    for _ in range(3):
        page.keyboard.press("Shift+ArrowLeft")
    wait_until(lambda: studio.at("time-axis").get_attribute("data-shown") is not None, "the past is shown")
    moment = float(studio.at("time-axis").get_attribute("data-shown") or "nan")

    page.keyboard.press("Alt+y")
    dialog = studio.at("tries")
    expect(dialog).to_be_visible()
    block = studio.at("tries-block").locator("option", has_text="Forward").get_attribute("value")
    studio.at("tries-block").select_option(block)
    expect(studio.at("tries-port")).to_have_value("lin_speed")
    studio.at("tries-how").select_option("list")
    studio.at("tries-list").fill("fast")
    expect(studio.at("tries-begin")).to_be_disabled()
    expect(studio.at("tries-preview")).to_contain_text("fast")
    studio.at("tries-how").select_option("range")
    studio.at("tries-from").fill("0.1")
    studio.at("tries-to").fill("0.9")
    expect(studio.at("tries-preview")).to_contain_text("0.1, 0.3, 0.5, 0.7, 0.9")
    studio.at("tries-duration").fill("4")
    page.keyboard.press("Enter")
    for row in range(6):
        expect(studio.at(f"tries-row-{row}")).to_contain_text(" m", timeout=60_000)
    expect(studio.at("tries-going")).to_have_count(0)
    expect(studio.at("tries-row-0")).to_contain_text("as in the run")
    expect(studio.at("tries-row-2")).to_contain_text("same as no. 0")
    expect(studio.at("tries-plan").locator("polyline")).to_have_count(6)
    outcomes_are_readable(studio)

    studio.at("tries-choose-0").uncheck()
    expect(studio.at("tries-3d")).to_contain_text("Show 5 paths in 3D")

    studio.at("tries-use-5").click()
    expect(studio.at("tries-row-5")).to_contain_text("written into the tree")
    studio.at("tries-branch-1").click()
    expect(dialog).to_have_count(0)
    studio.expect_state("application_running")
    expect(studio.at("axis-run")).to_contain_text("of run 1")
    wait_until(lambda: studio.stat("t") > moment + 1, "the branch runs on")
    studio.at("undo").click()
    studio.end_session()


def outcomes_are_readable(studio: Studio) -> None:
    """In both themes, and in a narrow window without scrolling sideways."""
    page = studio.page
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"the outcomes of five values, {scheme}")
        studio.picture(f"try-many-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    table = studio.at("tries-results").get_by_role("table")
    assert table.evaluate("each => each.parentElement.scrollWidth <= each.parentElement.clientWidth")
    studio.picture("try-many-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})


def test_the_code_of_a_past_tick_is_shown(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    page = studio.page
    studio.new_from("laser_bump_and_go")
    studio.command("Time of the next run: exact")
    studio.saved()
    studio.run()
    wait_until(lambda: studio.stat("t") > 3, "the robot drives for a while")
    studio.at("pause").click()
    studio.expect_state("paused")
    studio.at("axis-strip").focus()
    page.keyboard.press("Shift+ArrowLeft")
    wait_until(lambda: studio.at("time-axis").get_attribute("data-shown") is not None, "the past is shown")

    page.keyboard.press("Alt+j")
    view = studio.at("past-source")
    expect(studio.at("ran-code")).to_contain_text("class CheckObstacle", timeout=60_000)
    expect(view).to_contain_text("Returned <Status.FAILURE")
    updates = studio.at("source-call").locator("option", has_text="Forward.update of")
    studio.at("source-call").select_option(updates.first.get_attribute("value"))
    expect(studio.at("ran-code")).to_contain_text("twist = Twist()")
    ran = studio.at("ran-code").locator(".cm-ran")
    expect(ran).to_have_count(4)
    expect(ran.nth(1)).to_contain_text("x=0.3")  # the value behind the line that set it
    expect(studio.at("call-values")).to_contain_text("self.publisher")
    expect(studio.at("ran-code").get_by_role("textbox")).to_have_attribute("aria-readonly", "true")
    code_is_readable(studio)

    studio.at("axis-strip").focus()
    page.keyboard.press("ArrowLeft")  # another tick has other values
    expect(studio.at("source-ask")).to_be_visible()
    studio.at("source-ask").click()
    expect(studio.at("ran-code")).to_be_visible(timeout=60_000)
    page.keyboard.press("Escape")
    expect(view).to_have_count(0)
    studio.expect_state("paused")
    studio.end_session()


def code_is_readable(studio: Studio) -> None:
    """In both themes, and in a narrow window."""
    page = studio.page
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"the code of a past tick, {scheme}")
        studio.picture(f"past-source-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    expect(studio.at("ran-code")).to_be_visible()
    studio.picture("past-source-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
