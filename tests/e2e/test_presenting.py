"""Help for an audience: the values of ports inside blocks, and the tree alone on the screen."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.canvas_by_hand import block, focused
from tests.e2e.server import wait_until
from tests.e2e.test_hands_build import quick

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


@pytest.mark.long_walk
def test_values_in_blocks_and_the_tree_alone(studio: Studio) -> None:
    a_tree_that_waits_for_a_key(studio)
    the_block_shows_the_value_of_its_key(studio)
    the_tree_is_presented(studio)
    the_robot_comes_beside_it(studio)
    the_choice_is_kept(studio)
    studio.end_session()


def a_tree_that_waits_for_a_key(studio: Studio) -> None:
    studio.at("new-from-empty").click()
    focused(studio, "canvas")
    quick(studio, "Tab", "Sequence")
    quick(studio, "Tab", "Script")
    studio.at("port-code").click()
    expect(studio.page.locator("textarea:focus, [contenteditable=true]:focus")).to_have_count(1)
    studio.page.keyboard.type("wait := 2500")
    studio.at("canvas").focus()
    expect(block(studio, "Script")).to_contain_text("wait := 2500")
    quick(studio, "Control+Enter", "Sleep")
    studio.at("port-msec").fill("{wait}")
    studio.at("port-msec").press("Enter")
    studio.saved()


def shown(studio: Studio) -> Locator:
    return block(studio, "Sleep").locator("[data-testid^='value-']")


def the_block_shows_the_value_of_its_key(studio: Studio) -> None:
    """Also after the end: with its line, and shortened."""
    expect(shown(studio)).to_have_count(0)
    toggle = studio.at("inspector").get_by_role("button", name="Show the value of msec in the block")
    toggle.click()
    expect(toggle).to_have_attribute("aria-pressed", "true")
    expect(shown(studio)).to_have_text("{wait}")
    studio.at("run").click()
    expect(shown(studio)).to_have_text("2500")
    expect(shown(studio).locator("polyline")).to_be_attached()
    studio.expect_state("visualization_ready")
    expect(shown(studio)).to_have_text("2500")
    studio.picture("values-in-blocks")


def the_tree_is_presented(studio: Studio) -> None:
    """With its keys: Escape belongs to the smaller thing first, and the run keys still work."""
    page = studio.page
    small = width_of(block(studio, "Sleep"))
    studio.at("canvas").focus()
    page.keyboard.press("Alt+p")
    expect(studio.at("presentation")).to_be_visible()
    for hidden in (studio.at("run"), studio.at("inspector"), page.get_by_role("contentinfo")):
        expect(hidden).to_be_hidden()
    wait_until(lambda: width_of(block(studio, "Sleep")) > 1.3 * small, "the tree is larger")
    page.keyboard.press("F5")
    expect(block(studio, "Sleep")).to_have_attribute("data-status", "RUNNING")
    page.keyboard.press("Control+k")
    expect(studio.at("command-palette")).to_be_visible()
    page.keyboard.press("Escape")
    expect(studio.at("command-palette")).to_have_count(0)
    expect(studio.at("presentation")).to_be_visible()
    page.keyboard.press("Escape")
    expect(studio.at("presentation")).to_have_count(0)
    expect(studio.at("run")).to_be_visible()
    wait_until(lambda: abs(width_of(block(studio, "Sleep")) - small) < 2, "the view of before is back")


def width_of(element: Locator) -> float:
    box = element.bounding_box()
    return box["width"] if box else 0.0


def the_robot_comes_beside_it(studio: Studio) -> None:
    page = studio.page
    page.get_by_role("button", name="More", exact=True).click()
    studio.menu("More").get_by_role("menuitem", name="Present the tree").click()
    studio.at("presentation-robot").click()
    view = studio.page.locator("[data-presented=robot]").locator("> *").first
    expect(view).to_be_visible()
    tree = studio.at("canvas").bounding_box()
    robot = view.bounding_box()
    assert tree
    assert robot
    assert robot["x"] >= tree["x"] + tree["width"] - 1, "they are side by side"
    expect_no_findings(page, "presentation")
    studio.picture("presentation")
    studio.at("presentation-full").click()
    page.wait_for_function("document.fullscreenElement !== null")
    studio.at("presentation-end").click()
    page.wait_for_function("document.fullscreenElement === null")
    expect(studio.at("presentation")).to_have_count(0)


def the_choice_is_kept(studio: Studio) -> None:
    studio.page.reload()
    expect(shown(studio)).to_have_count(1)
    block(studio, "Sleep").click()
    studio.command("Show or hide the block's values")
    expect(shown(studio)).to_have_count(0)
