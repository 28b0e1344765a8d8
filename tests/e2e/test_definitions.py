"""Definitions outside of the project by hand: they open to be read, and lead on from there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.server import wait_until
from tests.e2e.test_code import begin, expect_help, line, spot

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]


def test_a_definition_outside_of_the_project_is_read_and_leads_on(studio: Studio) -> None:
    begin(studio)
    page, keys = studio.page, studio.page.keyboard
    expect_help(studio)
    page.mouse.click(*spot(studio, "return   py_trees.common", "common"))
    keys.press("F12")
    tab = page.get_by_test_id("source-tab").filter(visible=True)
    expect(tab.get_by_role("note")).to_contain_text("py_trees/common.py")
    expect(tab.get_by_role("note")).to_contain_text("read-only")
    text = tab.locator(".cm-content")
    expect(text).to_be_focused()

    # Nothing can be typed in it; its own names lead on, to Python's library.
    keys.type("changed")
    expect(text).not_to_contain_text("changed")
    keys.press("Control+f")
    keys.type("import enum")
    keys.press("Enter")
    keys.press("Escape")
    expect(text).to_be_focused()
    other = page.get_by_role("tab", name="enum.py")

    def leads_on() -> bool:
        """The server gives no answer while it still reads the text."""
        keys.press("F12")
        page.wait_for_load_state()
        return other.count() == 1

    wait_until(leads_on, "the definition opens", every_s=1.0)
    expect(page.get_by_test_id("source-tab").filter(visible=True)).to_contain_text("EnumType")
    for scheme in ("light", "dark"):
        expect_accessible(studio, scheme)
        studio.picture(f"code-definition-{scheme}")

    # It is there again after a reload, and the project has no new file.
    page.reload()
    expect(page.get_by_test_id("source-tab").filter(visible=True).locator(".cm-line").first).to_be_visible()
    expect(studio.at("file-enum.py")).to_have_count(0)
    page.get_by_role("tab", name="Forward.py").click()
    expect(line(studio, "import Twist").first).to_be_visible()
