"""A node of Nav2 is taken from the palette: its source comes with the block, and goes with undo."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.e2e.server import Server

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]


def test_a_node_of_nav2_comes_with_its_source(server: Server, browser: Browser) -> None:
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    studio = Studio(context.new_page(), server)
    studio.open()
    studio.at("new-from-empty").click()
    palette = studio.at("palette")
    palette.get_by_role("button", name="Nav2").click()
    expect(palette.get_by_test_id("palette-RateController")).to_be_visible()
    palette.get_by_test_id("palette-RateController").scroll_into_view_if_needed()
    studio.picture("palette-nav2")
    palette.get_by_label("Search nodes").fill("RecoveryNode")
    palette.get_by_test_id("palette-RecoveryNode").click()
    expect(studio.at("port-number_of_retries")).to_be_visible()
    studio.saved()
    studio.picture("palette-nav2-added")
    studio.at("canvas").press("Control+z")
    expect(studio.at("port-number_of_retries")).to_have_count(0)
    studio.page.get_by_role("button", name="Redo").click()
    expect(studio.at("port-number_of_retries")).to_be_visible()
    context.close()
    assert studio.complaints == []


def test_another_distribution_renames_the_nodes_and_undo_brings_them_back(
    server: Server, browser: Browser
) -> None:
    context = browser.new_context(viewport={"width": 1280, "height": 720})
    studio = Studio(context.new_page(), server)
    studio.open()
    studio.at("new-from-empty").click()
    palette = studio.at("palette")
    palette.get_by_label("Search nodes").fill("Path")
    expect(palette.get_by_test_id("palette-ValidatePath")).to_have_count(0)  # a new project is for Jazzy
    palette.get_by_test_id("palette-IsPathValid").click()
    studio.saved()
    studio.page.keyboard.press("Control+Comma")
    form = studio.at("settings")
    form.get_by_role("combobox", name="ROS 2 distribution of the robot").click()
    studio.page.get_by_role("option", name="Lyrical").click()
    studio.picture("distribution")
    form.get_by_role("button", name="Save").click()
    expect(form).to_have_count(0)
    canvas = studio.page.locator("[data-testid=canvas]:visible")
    expect(canvas.get_by_text("ValidatePath").first).to_be_visible()
    expect(palette.get_by_test_id("palette-IsPathValid")).to_have_count(0)
    expect(studio.page.get_by_text("The project is for Lyrical now.")).to_be_visible()
    studio.saved()
    studio.picture("distribution-changed")
    studio.page.get_by_role("button", name="Undo", exact=True).last.click()
    expect(canvas.get_by_text("IsPathValid").first).to_be_visible()
    expect(palette.get_by_test_id("palette-IsPathValid")).to_be_visible()
    studio.saved()
    context.close()
    assert studio.complaints == []
