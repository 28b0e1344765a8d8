"""The view of a tree follows its layout; menus open at the pointer, and new blocks are connected."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, children, middle, rest, takes_back
from tests.e2e.server import wait_until
from tests.e2e.test_canvas_hands import is_within

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]

TYPES = ("ReactiveSequence", "ReactiveFallback", "Forward", "Inverter", "Turn", "CheckObstacle")


def is_whole(studio: Studio) -> bool:
    """Whether all blocks of bump and go are in the canvas."""
    return all(block(studio, each).count() == 1 and is_within(studio, each) for each in TYPES)


def test_the_view_shows_the_whole_tree_after_what_changes_all_of_it(shared_studio: Studio) -> None:
    studio = shared_studio
    studio.new_from("laser_bump_and_go")
    rest(block(studio, "Turn"))
    for _ in range(2):
        studio.at("orientation").click()
        wait_until(lambda: is_whole(studio), "the turned tree is seen as a whole")

    # Folded and closely looked at, the tree is seen as a whole again once it is unfolded.
    menu_beside_blocks(studio, "collapse1")
    expect(block(studio, "Turn")).to_have_count(0)
    for _ in range(3):
        studio.at("canvas").get_by_role("button", name="Zoom in").click()
    rest(block(studio, "ReactiveSequence"))
    menu_beside_blocks(studio, "collapseAll")
    wait_until(lambda: is_whole(studio), "the unfolded tree is seen as a whole")

    # Beside the XML, whose edge is dragged as the user likes.
    studio.at("toggle-xml").click()
    expect(studio.at("xml-state")).to_be_visible()
    wait_until(lambda: is_whole(studio), "the tree is seen as a whole beside the XML")
    rest(block(studio, "Turn"))
    studio.picture("canvas-beside-xml-light")
    studio.at("toggle-xml").click()


def menu_beside_blocks(studio: Studio, item: str) -> None:
    canvas = studio.at("canvas").bounding_box()
    assert canvas
    studio.page.mouse.click(canvas["x"] + 40, canvas["y"] + canvas["height"] - 120, button="right")
    studio.at(f"menu-{item}").click()


def test_a_block_beside_a_single_leaf_is_connected_to_it(shared_studio: Studio) -> None:
    """Both come into a Sequence, in one step of undo."""
    studio = shared_studio
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


def test_menus_open_at_the_pointer(shared_studio: Studio) -> None:
    studio = shared_studio
    studio.new_from("laser_bump_and_go")
    for target in (studio.at("file-actions/Turn.py"), block(studio, "Turn")):
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
