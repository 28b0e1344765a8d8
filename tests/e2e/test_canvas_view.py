"""Menus open at the pointer, and new blocks are connected."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, children, middle, rest, takes_back

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]


def test_a_block_beside_a_single_leaf_is_connected_to_it(studio: Studio) -> None:
    """Both come into a Sequence, in one step of undo."""
    studio.new_from("laser_bump_and_go")
    keys = studio.page.keyboard
    block(studio, "ReactiveSequence").click()
    keys.press("Delete")
    expect(studio.at("ghost-block")).to_be_visible()
    add(studio, "Forward", "Tab")
    add(studio, "Turn", "Control+Enter")
    expect(block(studio, "Sequence")).to_have_count(1)
    assert children(studio) == ["Sequence", "Forward", "Turn"]
    takes_back(studio, ["Forward"])


def add(studio: Studio, type_: str, key: str) -> None:
    studio.page.keyboard.press(key)
    studio.writing()
    studio.page.keyboard.type(type_)
    studio.page.keyboard.press("Enter")
    expect(block(studio, type_)).to_be_visible()


def test_menus_open_at_the_pointer(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    for target in (studio.at("file-actions/Turn.py"), block(studio, "Turn")):
        target.scroll_into_view_if_needed()  # the Explorer may be longer than its panel
        x, y = middle(target)
        studio.page.mouse.click(x - 8, y, button="right")
        menu = studio.page.get_by_role("menu")
        expect(menu).to_be_visible()
        rest(menu)
        box = menu.bounding_box()
        assert box
        assert abs(box["x"] - (x - 8)) < 12
        studio.page.keyboard.press("Escape")
        expect(menu).to_have_count(0)
