"""Search, replacement and renaming of keys in the whole project, by mouse and keys."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]


def test_a_word_is_found_and_replaced_everywhere(studio: Studio) -> None:
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


def test_a_key_is_renamed_everywhere(studio: Studio) -> None:
    """A port's key, from the inspector: each place is shown, then changed, and taken back in one step."""
    page = studio.page
    studio.new_from("laser_bump_and_go")
    for type_, port in (("Forward", "lin_speed"), ("Turn", "ang_speed")):
        block(studio, type_).click()
        head = studio.at("inspector").locator("div").filter(has_text=port).last
        head.get_by_role("button", name="Use a blackboard key").first.click()
        studio.at(f"port-{port}").fill("{speed}")
        page.keyboard.press("Escape")
    page.get_by_role("button", name="Rename this key everywhere…").click()
    dialog = page.get_by_role("dialog")
    expect(studio.at("rename-key-new")).to_be_focused()
    page.keyboard.type("a b")
    expect(dialog).to_contain_text("cannot be a key")
    studio.at("rename-key-new").fill("cruise")
    plan = studio.at("rename-key-plan")
    expect(plan.locator("ins")).to_have_text(["{cruise}", "{cruise}"])
    expect(plan).to_contain_text("Turn · port ang_speed")
    studio.picture("rename-key")
    page.keyboard.press("Enter")
    expect(dialog).to_have_count(0)
    expect(studio.at("port-ang_speed")).to_have_value("{cruise}")
    expect(block(studio, "Forward")).to_contain_text("cruise")
    page.get_by_role("button", name="Undo", exact=True).last.click()
    expect(studio.at("port-ang_speed")).to_have_value("{speed}")
    studio.command("Rename a key")
    studio.at("rename-key-old").click()
    expect(page.get_by_role("option", name="speed — MainTree")).to_be_visible()
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    expect(dialog).to_have_count(0)
    studio.saved()
