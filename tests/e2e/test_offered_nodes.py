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
