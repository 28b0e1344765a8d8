"""Blocks, trees and library behaviours that travel between projects with what they use; by mouse and keys."""

from __future__ import annotations

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.canvas_by_hand import block
from tests.e2e.studio import Studio

DESCRIPTION = "Drives until something is near, then turns."

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]


def test_blocks_bring_what_they_use(studio: Studio) -> None:
    """A tree is described, offered and copied; another project takes it after a look, and gives it back."""
    studio.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    studio.new_from("laser_bump_and_go")
    name = studio.page.title().removesuffix(" — BT Studio")
    a_tree_is_described_and_offered(studio)
    block(studio, "ReactiveSequence").click()
    studio.page.keyboard.press("Control+c")
    other = Studio(studio.page.context.new_page(), studio.server)
    other.page.goto(studio.server.origin)
    other.at("new-from-empty").click()
    pasted_blocks_are_looked_at(other, name)
    one_undo_takes_all_back(other)
    a_clash_is_chosen(other)
    a_tree_of_the_menu_is_pasted(studio, other)
    an_offered_tree_is_in_every_library(other, name)
    a_library_behaviour_is_taken_back(other, name)
    assert other.complaints == []
    other.page.close()


def a_tree_is_described_and_offered(studio: Studio) -> None:
    studio.at("canvas").click(position={"x": 8, "y": 200})
    studio.at("tree-description").fill(DESCRIPTION)
    studio.saved()
    title = f"trees/MainTree.json\n{DESCRIPTION}"
    expect(studio.at("file-trees/MainTree.json")).to_have_attribute("title", title)
    studio.picture("tree-description")
    studio.at("file-trees/MainTree.json").click(button="right")
    studio.page.get_by_role("menuitem", name="Offer in the library").click()
    studio.saved()


def pasted_blocks_are_looked_at(studio: Studio, source: str) -> None:
    studio.at("canvas").click(position={"x": 8, "y": 200})
    studio.page.keyboard.press("Control+v")
    dialog = studio.page.get_by_role("dialog", name=f"Paste from {source}")
    expect(dialog).to_be_visible()
    dialog.get_by_role("button", name="Turn", exact=True).click()
    expect(dialog.locator(".cm-content")).to_contain_text("class Turn")
    studio.picture("paste-look")
    expect_accessible(studio, "light")
    expect(block(studio, "Turn")).to_have_count(0)
    studio.at("take-arrivals").click()
    expect(block(studio, "Turn")).to_be_visible()
    expect(studio.at("file-actions/Turn.py")).to_be_visible()
    studio.saved()


def one_undo_takes_all_back(studio: Studio) -> None:
    studio.page.keyboard.press("Control+z")
    expect(block(studio, "Turn")).to_have_count(0)
    expect(studio.at("file-actions/Turn.py")).to_have_count(0)
    studio.saved()
    studio.page.keyboard.press("Control+Shift+z")
    expect(block(studio, "Turn")).to_be_visible()
    expect(studio.at("file-actions/Turn.py")).to_be_visible()
    studio.saved()


def a_clash_is_chosen(studio: Studio) -> None:
    """The project's own Turn is edited; the same blocks are pasted again, once with each choice."""
    studio.open_file("actions/Turn.py")
    studio.at("code-editor").locator(".cm-content").click()
    studio.page.keyboard.press("Control+Home")
    studio.page.keyboard.type("# mine")
    studio.page.keyboard.press("Enter")
    studio.saved()
    studio.at("file-trees/MainTree.json").click()
    block(studio, "ReactiveSequence").click()
    studio.page.keyboard.press("Control+v")
    row = studio.at("arrival-actions/Turn.py")
    expect(row).to_contain_text("the incoming one is named Turn2")
    row.get_by_role("button", name="Turn", exact=True).click()
    expect(row.locator(".cm-merge-a")).to_contain_text("# mine")
    row.get_by_text("Keep mine").click()
    expect(row).to_contain_text("the blocks use it")
    studio.at("theme-toggle").evaluate("button => button.click()")
    expect_accessible(studio, "dark")
    studio.picture("paste-clash-dark")
    studio.at("theme-toggle").evaluate("button => button.click()")
    row.get_by_text("Rename", exact=True).click()
    studio.at("take-arrivals").click()
    expect(block(studio, "Turn2")).to_be_visible()
    expect(studio.at("file-actions/Turn2.py")).to_be_visible()
    studio.saved()
    studio.page.keyboard.press("Control+z")
    expect(studio.at("file-actions/Turn2.py")).to_have_count(0)


def a_tree_of_the_menu_is_pasted(source: Studio, studio: Studio) -> None:
    # A browser lets only the page in front write to the clipboard.
    source.page.bring_to_front()
    source.at("file-trees/MainTree.json").click(button="right")
    source.page.get_by_role("menuitem", name="Copy", exact=True).click()
    expect(source.page.get_by_text("MainTree is copied")).to_be_visible()
    studio.page.bring_to_front()
    block(studio, "ReactiveSequence").click()
    studio.page.keyboard.press("Control+v")
    expect(studio.at("arrival-trees/MainTree.json")).to_contain_text("the incoming one is named MainTree2")
    studio.page.keyboard.press("Escape")
    expect(studio.at("take-arrivals")).to_have_count(0)
    expect(block(studio, "SubTree")).to_have_count(0)


def an_offered_tree_is_in_every_library(studio: Studio, source: str) -> None:
    """The user need not know which project offers it."""
    page = studio.page
    page.locator(".flexlayout__tab_button", has_text="Library").click()
    offered = studio.at("library").get_by_role("list", name="Offered by projects")
    row = offered.get_by_test_id("behaviour-MainTree")
    expect(row).to_contain_text(f"From {source}")
    expect(row).to_contain_text(DESCRIPTION)
    expect(studio.at("behaviour-DriveForward")).to_be_visible()
    expect_accessible(studio, "light")
    studio.picture("library-offered")
    offered.get_by_test_id("insert-MainTree").click()
    studio.at("take-arrivals").click()
    expect(studio.at("file-trees/MainTree2.json")).to_be_visible()
    studio.saved()
    studio.at("undo").click()
    expect(studio.at("file-trees/MainTree2.json")).to_have_count(0)
    studio.saved()


def a_library_behaviour_is_taken_back(studio: Studio, source: str) -> None:
    page = studio.page
    studio.at("library-source").click()
    studio.at("library-source").fill(source[:6])
    page.get_by_role("option", name=source, exact=True).click()
    row = studio.at("behaviour-MainTree")
    expect(row).to_contain_text("Drives until something is near")
    row.get_by_role("button", name="MainTree", exact=True).click()
    expect(row).to_contain_text(f"As it is now in {source}")
    studio.picture("library-of-a-project")
    studio.at("insert-MainTree").click()
    studio.at("take-arrivals").click()
    expect(studio.at("file-trees/MainTree2.json")).to_be_visible()
    expect(studio.at("file-assets/library.json")).to_be_visible()
    studio.saved()
    studio.at("undo").click()
    expect(studio.at("file-trees/MainTree2.json")).to_have_count(0)
    expect(studio.at("file-assets/library.json")).to_have_count(0)
    studio.saved()
