"""Search and replacement in the whole project, by mouse and keys."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]


def test_a_word_is_found_and_replaced_everywhere(shared_studio: Studio) -> None:
    studio = shared_studio
    studio.new_from("laser_bump_and_go")
    hits_lead_to_block_and_line(studio)
    expressions_are_checked_and_stopped(studio)
    a_replacement_is_shown_made_and_taken_back(studio)


def search(studio: Studio, text: str) -> None:
    """Types a text into the search of the project."""
    studio.page.keyboard.press("Control+Shift+KeyF")
    expect(studio.at("search-text")).to_be_focused()
    studio.at("search-text").fill(text)


def hits(studio: Studio, path: str) -> Locator:
    return studio.at(f"search-in-{path}").locator("[data-row]")


def hits_lead_to_block_and_line(studio: Studio) -> None:
    keys = studio.page.keyboard
    search(studio, "class forward")
    line = hits(studio, "actions/Forward.py")
    expect(line).to_have_count(1)
    expect(line.locator("mark")).to_have_text("class Forward")
    keys.press("ArrowDown")
    expect(line).to_be_focused()
    keys.press("Enter")
    expect(studio.at("code-editor").locator(".cm-activeLine")).to_contain_text("class Forward")
    search(studio, "Turn")
    hits(studio, "trees/MainTree.json").first.click()
    expect(block(studio, "Turn")).to_have_attribute("data-selected", "true")
    studio.picture("search")


def expressions_are_checked_and_stopped(studio: Studio) -> None:
    block(studio, "Turn").click()
    studio.page.keyboard.press("Slash")
    studio.writing()
    studio.page.keyboard.type("a" * 40 + "!")
    studio.page.keyboard.press("Control+Enter")
    search(studio, "(a+")
    panel = studio.at("search")
    panel.get_by_role("button", name="Regular expression").click()
    expect(panel).to_contain_text("not a regular expression: Unterminated group")
    search(studio, "^(a+)+$")
    expect(panel).to_contain_text("takes too long")
    search(studio, "^a+!$")
    expect(hits(studio, "trees/MainTree.json").locator("mark")).to_have_text("a" * 40 + "!")
    panel.get_by_role("button", name="Regular expression").click()


def a_replacement_is_shown_made_and_taken_back(studio: Studio) -> None:
    panel = studio.at("search")
    search(studio, "Turn")
    panel.get_by_role("button", name="Whole words only").click()
    panel.get_by_role("button", name="Replace", exact=True).click()
    studio.at("search-replacement").fill("Spin")
    code = hits(studio, "actions/Turn.py")
    expect(code.locator("ins").first).to_have_text("Spin")
    studio.picture("replace")
    studio.at("replace-all").click()
    expect(code).to_have_count(0)
    studio.saved()
    studio.page.get_by_role("button", name="Undo", exact=True).last.click()
    expect(code.first).to_be_visible()
    studio.saved()
