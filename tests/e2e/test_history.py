"""The tree as text beside its canvas, and older revisions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Route

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]


def line(studio: Studio, text: str) -> Locator:
    return studio.at("xml-editor").locator(".cm-line", has_text=text).first


def expect_xml(studio: Studio, state: str) -> None:
    expect(studio.at("xml-state")).to_have_attribute("data-state", state)


def test_what_was_comes_back(studio: Studio) -> None:
    text_and_canvas_stay_in_step_and_every_state_comes_back(studio)
    a_file_goes_back_by_the_explorers_menu(studio)
    a_problem_is_fixed_by_keys(studio)
    a_page_waits_for_its_style(studio)


def text_and_canvas_stay_in_step_and_every_state_comes_back(studio: Studio) -> None:
    page = studio.page
    studio.new_from("laser_bump_and_go")
    page.keyboard.press("Control+Shift+X")
    expect_xml(studio, "inStep")

    # The selection of one side is marked on the other.
    studio.at("node-n4").click()
    expect(line(studio, "<CheckObstacle")).to_contain_class("cm-chosenNode")
    line(studio, "<Forward").click()
    expect(studio.at("port-lin_speed")).to_be_visible()

    # Typed text becomes the tree in one step; invalid text waits, and survives a reload.
    page.keyboard.press("End")
    page.keyboard.insert_text("\n<!-- rest --><Sleep msec='200'/>")
    expect_xml(studio, "inStep")
    slept = page.locator("[data-testid=canvas] [data-type=Sleep]")
    expect(slept).to_have_count(1)
    studio.saved()
    page.keyboard.insert_text("<Half")
    expect_xml(studio, "broken")
    page.reload()
    expect_xml(studio, "broken")
    expect(studio.at("xml-state")).to_contain_text("Your text was restored.")
    studio.picture("xml-broken-light")

    # The canvas changes meanwhile: the user is asked, and takes the tree; the comment is still in the text.
    studio.at("toolbar-toggle").click()  # beside the text, the canvas is narrow and its tools are folded
    studio.at("orientation").click()
    expect_xml(studio, "parted")
    expect_accessible(studio, "dark")
    studio.picture("xml-parted-dark")
    studio.at("xml-keep-tree").click()
    expect_xml(studio, "inStep")
    expect(line(studio, "<!-- rest --><Sleep")).to_be_visible()
    expect(line(studio, "<Half")).to_have_count(0)
    page.keyboard.press("Control+Shift+X")
    expect(studio.at("xml-editor")).to_have_count(0)
    studio.saved()

    # The history: differences as a picture and in words, a name, and a restored revision, which Undo reverts.
    page.keyboard.press("Control+Shift+H")
    page.locator("[data-testid^=revision-]").first.click()
    expect(page.locator("[data-change=added]")).to_have_count(1)
    studio.picture("history-dark")
    expect_accessible(studio, "light")
    studio.picture("history-light")
    studio.at("label-1").click()
    page.get_by_label("Name of this revision").fill("The example")
    page.keyboard.press("Enter")
    studio.at("revision-1").click()
    expect(page.get_by_role("heading", name="The example #1")).to_be_visible()
    studio.at("restore").click()
    studio.at("restore-project").click()
    expect(slept).to_have_count(0)
    page.get_by_role("button", name="Undo", exact=True).last.click()
    expect(slept).to_have_count(1)
    page.keyboard.press("Control+Shift+H")
    studio.saved()


def a_file_goes_back_by_the_explorers_menu(studio: Studio) -> None:
    page = studio.page
    page.get_by_role("tab", name="Explorer", exact=True).click()
    page.get_by_role("button", name="More for MainTree").click()
    studio.menu("More for MainTree").get_by_role("menuitem", name="History").click()
    studio.at("revision-1").click()
    studio.at("restore").click()
    studio.at("restore-file").click()
    page.get_by_role("tab", name="MainTree", exact=True).click()
    expect(studio.at("node-n1")).to_be_visible()
    expect(page.locator("[data-testid=canvas] [data-type=Sleep]")).to_have_count(0)
    studio.saved()


def a_problem_is_fixed_by_keys(studio: Studio) -> None:
    """A key without its brace: `Ctrl+.` offers the fix, Enter applies it, and the canvas has the focus."""
    forward = studio.page.locator("[data-testid=canvas] [data-type=Forward]")
    forward.click()
    field = studio.at("port-lin_speed")
    field.fill("{speed")
    field.press("Enter")
    expect(forward).to_have_attribute("data-problem", "error")
    forward.click()
    studio.page.keyboard.press("Control+Period")
    expect(studio.at("fix-box").locator("button").first).to_be_focused()
    studio.page.keyboard.press("Enter")
    expect(studio.at("fix-box")).to_be_hidden()
    expect(forward).not_to_have_attribute("data-problem", "error")
    expect(studio.at("canvas")).to_be_focused()
    studio.saved()


def a_page_waits_for_its_style(studio: Studio) -> None:
    """Each style sheet is lost once, as on a server that is too busy to answer."""
    page = studio.page.context.new_page()
    lost: set[str] = set()

    def lose_once(route: Route) -> None:
        if route.request.url in lost:
            route.continue_()
        else:
            lost.add(route.request.url)
            route.abort("timedout")

    page.route("**/assets/*.css", lose_once)
    page.goto(studio.page.url)
    expect(page.get_by_test_id("canvas")).to_be_visible()
    assert len(lost) >= 2, "the first page and the editor have a style each"
    expect(page.get_by_test_id("canvas")).to_have_css("position", "relative")
    expect(page.get_by_test_id("palette")).to_have_css("display", "flex")
    page.close()
