"""An exact run is taken back to a moment, and runs on from there."""

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


def test_an_exact_run_goes_back_and_runs_on(
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
    expect(studio.at("axis-go-back")).not_to_be_visible()

    studio.at("axis-strip").focus()
    for _ in range(3):
        page.keyboard.press("Shift+ArrowLeft")
    expect(studio.at("axis-go-back")).to_be_visible()
    wait_until(lambda: studio.at("time-axis").get_attribute("data-shown") is not None, "the past is shown")
    moment = float(studio.at("time-axis").get_attribute("data-shown") or "nan")
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"the way back is offered, {scheme}")
        studio.picture(f"go-back-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    expect(studio.at("axis-go-back")).to_be_in_viewport()
    studio.picture("go-back-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    page.keyboard.press("Alt+b")
    wait_until(lambda: abs(studio.stat("t") - moment) < 0.2, "world and program are back")
    studio.expect_state("paused")
    expect(studio.at("axis-run")).to_contain_text("of run 1")
    studio.picture("gone-back")
    page.set_viewport_size({"width": 390, "height": 800})
    studio.picture("gone-back-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    one_tick_back(studio)

    studio.at("resume").click()
    studio.expect_state("application_running")
    wait_until(lambda: studio.stat("t") > moment + 1, "it runs on")
    studio.at("pause").click()
    studio.expect_state("paused")
    studio.at("axis-run").select_option(index=1)
    expect(studio.at("time-axis")).to_have_attribute("data-past", "true")
    studio.at("axis-strip").focus()
    page.keyboard.press("End")
    studio.at("axis-go-back").click()
    wait_until(lambda: studio.stat("t") > moment + 2, "the run before is at its end again")
    studio.expect_state("paused")
    studio.end_session()


def one_tick_back(studio: Studio) -> None:
    """By its key and by its button, tick by tick; the one that follows is made again."""
    begin = studio.stat("t")
    studio.page.keyboard.press("Control+Shift+F10")
    wait_until(lambda: abs(studio.stat("t") - begin + 0.05) < 0.01, "the run is one tick back")
    studio.expect_state("paused")
    studio.at("tick-back").click()
    wait_until(lambda: abs(studio.stat("t") - begin + 0.1) < 0.01, "and one more")
    studio.expect_state("paused")
    expect(studio.at("axis-run").locator("option")).to_have_count(2)  # the run, and one branch of it
    studio.at("step").click()
    wait_until(lambda: abs(studio.stat("t") - begin + 0.05) < 0.01, "the tick is made again")
    studio.picture("one-tick-back")


@pytest.mark.long_walk
def test_the_touch_of_a_crate_is_undone_from_three_seconds_before(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    page = studio.page
    studio.new_from("laser_bump_and_go")
    studio.command("Time of the next run: exact")
    studio.set_port("n4", "obs_dist", "0.3")
    studio.saved()
    studio.run()
    wait_until(lambda: studio.stat("collisions") > 0, "the robot touches a crate", deadline_s=120)
    studio.at("pause").click()
    studio.expect_state("paused")
    touched, before = studio.stat("t"), studio.stat("collisions")
    studio.set_port("n4", "obs_dist", "1.2")
    studio.saved()
    expect(studio.at("axis-run-on")).to_be_visible()
    studio.at("axis-strip").focus()
    for _ in range(3):
        page.keyboard.press("Shift+ArrowLeft")
    wait_until(lambda: studio.at("time-axis").get_attribute("data-shown") is not None, "the past is shown")
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"to run on is offered, {scheme}")
        studio.picture(f"run-on-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    expect(studio.at("axis-run-on")).to_be_in_viewport()
    studio.picture("run-on-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    page.keyboard.press("Alt+Shift+b")
    expect(studio.at("axis-run")).to_contain_text("of run 1")
    studio.expect_state("application_running")
    wait_until(lambda: studio.stat("t") > touched + 5, "it runs on past the moment of the touch")
    assert studio.stat("collisions") < before
    studio.picture("ran-on")
    studio.at("pause").click()
    studio.expect_state("paused")
    compare_with_the_run_before(studio, touched)
    studio.end_session()


def compare_with_the_run_before(studio: Studio, touched: float) -> None:
    """Compares the branch, which keeps away, with the run that drove into the crate."""
    page = studio.page
    studio.command("Compare with")
    panel = studio.at("axis-compared")
    expect(panel).to_contain_text("Run 1")
    shown = studio.at("time-axis")
    wait_until(
        lambda: abs(float(shown.get_attribute("data-shown") or "nan") - touched) < 0.5,
        "the end of the run before is shown",
    )
    panel.get_by_role("button", name="They part at").click()
    expect(panel).to_contain_text("both are one run")
    studio.at("axis-strip").focus()
    row = studio.at("compared-row").first
    for _ in range(60):  # three seconds, after which the other run touched the crate
        before = shown.get_attribute("data-shown") or ""
        page.keyboard.press("ArrowRight")
        expect(shown).not_to_have_attribute("data-shown", before)  # each step is one from what is shown
        if row.is_visible():
            break
    expect(row).to_be_visible()
    mark = page.locator("[data-testid^='compared-MainTree/']").first
    expect(mark).to_contain_text("2: ")
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"two runs compared, {scheme}")
        studio.picture(f"compared-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    expect(studio.at("compared-end")).to_be_in_viewport()
    studio.picture("compared-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    page.keyboard.press("Escape")
    expect(panel).to_have_count(0)
    expect(studio.at("time-axis")).to_have_attribute("data-past", "true")


@pytest.mark.long_walk
def test_a_live_run_goes_back_and_its_branch_gets_a_name_and_goes(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    page = studio.page
    studio.new_from("laser_bump_and_go")
    studio.run()
    wait_until(lambda: studio.stat("t") > 8, "the robot drives for a while")
    studio.at("pause").click()
    studio.expect_state("paused")
    for number in range(2):
        studio.at("axis-strip").focus()
        page.keyboard.press("Shift+ArrowLeft")
        wait_until(
            lambda: studio.at("time-axis").get_attribute("data-shown") is not None, "the past is shown"
        )
        studio.at("axis-go-back").click()
        expect(studio.at("axis-run")).to_contain_text(f"of run {number + 1}")
        studio.expect_state("paused")
        studio.at("resume").click()
        wait_until(lambda: studio.stat("t") > 7, "it runs on")
        studio.at("pause").click()
        studio.expect_state("paused")
    studio.at("axis-run").select_option(index=1)
    expect(studio.at("time-axis")).to_have_attribute("data-past", "true")
    studio.command("Name the shown branch")
    studio.at("branch-name").fill("wider turns")
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"a branch gets a name, {scheme}")
        studio.picture(f"branch-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    expect(studio.at("branch-drop")).to_be_in_viewport()
    studio.picture("branch-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    studio.at("branch-keep").click()
    expect(studio.at("axis-run")).to_contain_text("wider turns")
    studio.command("Name the shown branch")
    studio.at("branch-drop").click()
    studio.at("branch-drop").click()
    expect(studio.at("axis-run")).not_to_contain_text("wider turns")
    studio.end_session()
