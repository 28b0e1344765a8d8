"""Behaviour tests beside the tree: they run after each save, and lead to the block that failed."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]
FILE = "tests/bump_and_go.test.yaml"
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "laser_bump_and_go"


def test_a_test_that_fails_leads_to_its_block(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.new_from("laser_bump_and_go")
    studio.page.get_by_role("tab", name="Tests", exact=True).click()
    panel = studio.at("tests")
    expect(panel.get_by_test_id("tests-summary")).to_have_text("3 passed, 0 failed")
    expect(panel.get_by_role("status")).to_contain_text("100 % of the trees covered")
    studio.picture("tests-passed")
    what_a_test_covers_is_on_the_canvas(studio)
    panel.get_by_role("button", name=re.compile("^Passed looks at every tick")).click()
    text = (EXAMPLE / FILE).read_text(encoding="utf-8")
    studio.replace_code(text.replace("node: Turn, status: IDLE", "node: Turn, status: RUNNING"))
    expect(panel.get_by_test_id("tests-summary")).to_have_text("2 passed, 1 failed")
    failure = panel.get_by_role(
        "button", name="Tick 1 (0 s): status after the tick: wanted RUNNING, got IDLE"
    )
    studio.picture("tests-failed-light")
    studio.at("theme-toggle").click()
    studio.page.wait_for_timeout(400)  # the theme fades in; the picture is for people
    studio.picture("tests-failed-dark")
    failure.click()
    expect(studio.at("inspector")).to_have_attribute("aria-label", "Turn")
    a_mark_leads_to_the_line_and_back(studio)
    studio.page.set_viewport_size({"width": 390, "height": 844})
    studio.page.get_by_role("tab", name="Tests", exact=True).click()
    expect(panel.get_by_test_id("tests-summary")).to_be_visible()
    studio.picture("tests-narrow")
    studio.page.get_by_role("tab", name="MainTree", exact=True).click()
    studio.page.keyboard.press("Alt+KeyC")
    expect(studio.at("coverage-legend")).to_be_visible()
    studio.picture("coverage-narrow")


def what_a_test_covers_is_on_the_canvas(studio: Studio) -> None:
    studio.page.keyboard.press("Alt+KeyC")
    legend = studio.at("coverage-legend")
    expect(legend).to_contain_text("100 %")
    expect(studio.at("coverage-mark")).to_have_count(6)
    one = "drives ahead while the way is free"
    legend.get_by_role("combobox").select_option(label=one)
    expect(legend).not_to_contain_text("100 %")
    studio.at("node-n3").click()
    expect(studio.at("node-coverage")).to_contain_text("Partly covered")
    studio.picture("coverage-light")
    studio.at("theme-toggle").click()
    studio.page.wait_for_timeout(400)  # the theme fades in; the picture is for people
    studio.picture("coverage-dark")
    studio.at("theme-toggle").click()
    legend.get_by_role("button", name="Hide the coverage").click()
    expect(studio.at("coverage-mark")).to_have_count(0)


def a_mark_leads_to_the_line_and_back(studio: Studio) -> None:
    mark = studio.at("failure-mark")
    expect(mark).to_have_attribute("aria-label", re.compile("wanted RUNNING, got IDLE"))
    studio.picture("tests-mark")
    mark.click()
    editor = studio.at("code-editor")
    expect(editor).to_have_attribute("data-path", FILE)
    editor.locator(".cm-lintRange-error").first.hover()
    studio.page.get_by_role("button", name="Show the block").click()
    expect(studio.at("canvas")).to_be_visible()
    expect(mark).to_be_visible()


@pytest.mark.simulation
def test_a_recorded_moment_becomes_a_test(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.new_from("follow_line")
    studio.run()
    wait_until(lambda: studio.stat("t") > 4, "the robot follows the line for a while")
    studio.at("pause").click()
    studio.expect_state("paused")
    studio.page.get_by_role("tab", name="Tests", exact=True).click()
    a_test_is_written_and_taken_back(studio)
    a_moment_of_the_past_is_written(studio)
    studio.end_session()
    it_fails_with_a_mark_when_the_tree_changes(studio)


def make_a_test(studio: Studio, name: str, *, entry: str = "") -> None:
    studio.at("axis-test").click()
    dialog = studio.page.get_by_role("dialog", name="Make a test of this moment")
    field = dialog.get_by_role("textbox", name="Name")
    expect(field).to_have_value(re.compile("as at tick [0-9]+"))
    field.fill(name)
    if entry:
        dialog.get_by_role("checkbox", name=re.compile(f"^{entry} is ")).check()
    studio.picture(f"moment-{name}".replace(" ", "-"))
    dialog.get_by_role("button", name="Write the test").click()
    expect(dialog).to_have_count(0)


def a_test_is_written_and_taken_back(studio: Studio) -> None:
    make_a_test(studio, "the end of it")
    panel = studio.at("tests")
    expect(panel.get_by_test_id("tests-summary")).to_have_text("1 passed, 0 failed")
    studio.page.get_by_role("button", name="Undo", exact=True).last.click()
    expect(panel).to_contain_text("No tests yet")


def a_moment_of_the_past_is_written(studio: Studio) -> None:
    strip = studio.at("axis-strip")
    strip.focus()
    for _ in range(5):
        studio.page.keyboard.press("ArrowLeft")
    expect(studio.at("moment-stats")).to_be_visible()
    make_a_test(studio, "on the line", entry="offset")
    expect(studio.at("tests").get_by_test_id("tests-summary")).to_have_text("1 passed, 0 failed")
    text = studio.at("code-editor").inner_text()
    assert re.search(r"SeesLine:\n\s+- \{at: 1, status: \w+", text)
    expect(studio.page.get_by_text("The program changed since it was started")).to_have_count(0)
    studio.picture("moment-written")


def it_fails_with_a_mark_when_the_tree_changes(studio: Studio) -> None:
    studio.page.get_by_role("tab", name="MainTree", exact=True).click()
    studio.at("node-n4").click()
    studio.page.keyboard.press("Control+ArrowLeft")  # it steers before it looks
    summary = studio.at("tests").get_by_test_id("tests-summary")
    expect(summary).to_have_text("0 passed, 1 failed")
    expect(studio.at("failure-mark").first).to_be_visible()
    studio.picture("moment-failed")
    studio.at("node-n4").click()
    studio.page.keyboard.press("Control+z")
    expect(summary).to_have_text("1 passed, 0 failed")
    expect(studio.at("failure-mark")).to_have_count(0)
