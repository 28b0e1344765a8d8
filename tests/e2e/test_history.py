"""The tree as text beside its canvas, and the way back to what was saved before."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]


def line(studio: Studio, text: str) -> Locator:
    return studio.at("xml-editor").locator(".cm-line", has_text=text).first


def expect_xml(studio: Studio, state: str) -> None:
    expect(studio.at("xml-state")).to_have_attribute("data-state", state)


def test_text_and_canvas_stay_in_step_and_every_state_comes_back(shared_studio: Studio) -> None:
    studio = shared_studio
    page = studio.page
    studio.new_from("laser_bump_and_go")
    page.keyboard.press("Control+Shift+X")
    expect_xml(studio, "inStep")

    # What is selected on one side is marked on the other.
    studio.at("node-n4").click()
    expect(line(studio, "<CheckObstacle")).to_contain_class("cm-chosenNode")
    line(studio, "<Forward").click()
    expect(studio.at("port-lin_speed")).to_be_visible()

    # A text that is typed becomes the tree in one step; one that cannot be read waits, and survives a reload.
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
    expect(studio.at("xml-state")).to_contain_text("What you typed is back.")
    studio.picture("xml-broken-light")

    # The canvas goes on meanwhile: the user is asked, and takes the tree; the comment is still in the text.
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

    # The history: what differs, in a picture and in words; a name; and back, which Undo takes back.
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
