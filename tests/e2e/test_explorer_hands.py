"""The universe and the robot that a project uses: listed, changed, copied, renamed and filled by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import RARELY_S, wait_until

if TYPE_CHECKING:
    from playwright.sync_api import FloatRect, Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

COPY = "file-universes/my_walled_room.yaml"


def test_what_a_project_runs_with_is_changed_and_copied(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    universe, robot = studio.at("used-universe"), studio.at("used-robot")
    expect(universe).to_contain_text("Walled room")
    expect(robot).to_contain_text("placed by the world")
    studio.picture("explorer-runs-with")
    the_robot_is_changed(studio, robot)
    a_copy_is_made_and_undone(studio, universe)
    universe.click(button="right")
    studio.page.get_by_role("menuitem", name="Make my own copy").click()
    expect(studio.at(COPY)).to_be_visible()
    expect(studio.at("universe-view").locator("canvas")).to_be_visible()
    ghosts_are_placed(studio)
    a_drag_is_given_up(studio)
    the_title_follows(studio, universe)


def the_robot_is_changed(studio: Studio, robot: Locator) -> None:
    """By keyboard: the chooser opens at the robots."""
    studio.at("change-robot").focus()
    studio.page.keyboard.press("Enter")
    expect(studio.at("worlds").get_by_role("radio", name="The world's own")).to_be_focused()
    studio.at("choice-burger").click()
    studio.at("choose-world").click()
    expect(robot).to_contain_text("Burger")
    expect(robot).to_contain_text("Built in")


def a_copy_is_made_and_undone(studio: Studio, universe: Locator) -> None:
    studio.at("copy-universe").focus()
    studio.page.keyboard.press("Enter")
    expect(universe).to_contain_text("My walled room")
    expect(universe).to_contain_text("Of this project")
    expect(studio.page.get_by_role("tab", name="My walled room")).to_be_visible()
    done = studio.page.get_by_role("alert").filter(has_text="is now in the project")
    done.get_by_role("button", name="Undo").press("Enter")
    expect(universe).to_contain_text("Built in")
    expect(studio.at(COPY)).to_have_count(0)
    expect(studio.page.get_by_role("tab", name="My walled room")).to_have_count(0)


def sized(canvas: Locator) -> FloatRect:
    """Returns the box of a 3D view's canvas, once it fills its view: it begins with a size of its own."""
    fills = "c => Math.abs(c.clientHeight - c.closest('[data-testid=universe-view]').clientHeight) < 2"
    wait_until(lambda: canvas.evaluate(fills), "the canvas fills its view")
    box = canvas.bounding_box()
    assert box
    return box


def ghosts_are_placed(studio: Studio) -> None:
    """A ghost follows the pointer; a click, a drag from the palette and Enter place it, Esc does not."""
    mouse, keys = studio.page.mouse, studio.page.keyboard
    view, hint = studio.at("universe-view"), studio.at("placing")
    canvas = view.locator("canvas")
    box = sized(canvas)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    count = int(view.get_attribute("data-things") or "0")
    view.press("t")
    studio.at("place-crate").click()
    expect(hint).to_contain_text("Crate")
    mouse.move(x, y)
    before = canvas.screenshot()
    mouse.move(x + 60, y, steps=3)
    wait_until(lambda: canvas.screenshot() != before, "the ghost follows the pointer", every_s=RARELY_S)
    studio.picture("universe-ghost")
    keys.press("Escape")
    expect(hint).to_be_empty()
    studio.at("place-crate").click()
    mouse.click(x + 60, y, button="right")
    expect(hint).to_be_empty()
    expect(view).to_have_attribute("data-things", str(count))
    studio.at("place-crate").click()
    keys.down("Shift")
    mouse.click(x + 60, y)
    mouse.click(x + 60, y + 60)
    keys.up("Shift")
    expect(hint).to_contain_text("Crate")
    mouse.click(x - 60, y)
    expect(view).to_have_attribute("data-things", str(count + 3))
    expect(hint).to_be_empty()
    studio.at("place-ball").focus()
    for key in ("Enter", "ArrowRight", "Enter"):
        keys.press(key)
    expect(view).to_have_attribute("data-things", str(count + 4))
    expect(studio.at("thing-ball")).to_have_attribute("aria-selected", "true")
    keys.press("Control+z")
    expect(view).to_have_attribute("data-things", str(count + 3))


def a_drag_is_given_up(studio: Studio) -> None:
    """Esc puts a dragged thing back; the release that follows does nothing."""
    mouse, keys, view = studio.page.mouse, studio.page.keyboard, studio.at("universe-view")
    canvas = view.locator("canvas")
    box = sized(canvas)
    x, y = box["x"] + box["width"] / 2 + 60, box["y"] + box["height"] / 2
    view.press("Escape")
    expect(studio.at("world-fields")).to_be_visible()
    fields = studio.at("thing-fields")

    def is_chosen() -> bool:
        """A thing can be chosen once it is drawn where it was put."""
        mouse.click(x, y)
        try:
            expect(fields).to_be_visible(timeout=5000)
        except AssertionError:
            return False
        return True

    wait_until(is_chosen, "the crate is chosen")
    place = [fields.get_by_test_id(f"field-{axis}").input_value() for axis in "xy"]
    view.press("Escape")
    expect(studio.at("world-fields")).to_be_visible()  # nothing is selected, and no handle is in the way
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 80, y + 40, steps=4)
    keys.press("Escape")
    mouse.up()
    expect(studio.at("world-fields")).to_be_visible()
    wait_until(is_chosen, "the crate is chosen again")
    assert [fields.get_by_test_id(f"field-{axis}").input_value() for axis in "xy"] == place


def the_title_follows(studio: Studio, universe: Locator) -> None:
    """The tab and the list follow the document's name, and the name follows that of the file."""
    tab = studio.page.get_by_role("tab")
    studio.at("universe-view").press("Escape")
    name = studio.at("world-fields").get_by_label("Name of the world")
    name.fill("My yard")
    name.press("Enter")
    expect(tab.filter(has_text="My yard")).to_be_visible()
    expect(universe).to_contain_text("My yard")
    name.fill("My walled room")
    name.press("Enter")
    studio.page.get_by_role("button", name="More for my_walled_room.yaml").click()
    studio.menu("More for my_walled_room.yaml").get_by_role("menuitem", name="Rename").click()
    studio.page.get_by_role("dialog").get_by_role("textbox").fill("big_garden")
    studio.page.keyboard.press("Enter")
    expect(tab.filter(has_text="Big garden")).to_be_visible()
    expect(universe).to_contain_text("Big garden")
