"""The editor without a robot: the inspector, the view of a tree, and very large trees."""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, focused, middle, paste, place, rest, selected, takes_back, wrap
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

ORDER = ["ReactiveSequence", "ReactiveFallback", "Forward", "Inverter", "Turn", "CheckObstacle"]


def inspector(studio: Studio) -> Locator:
    return studio.at("inspector")


@pytest.mark.long_walk
def test_every_field_of_the_inspector(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    numbers_and_keys(studio)
    truth_choices_and_scripts(studio)
    conditions_are_written(studio)
    looks_and_words(studio)
    one_field_takes_a_hundred_kilobytes(studio)


def numbers_and_keys(studio: Studio) -> None:
    """A number steps by arrows and refuses words; a key is completed from the known ones."""
    keys = studio.page.keyboard
    forward, speed = block(studio, "Forward"), studio.at("port-lin_speed")
    block(studio, "ReactiveSequence").click()
    wrap(studio, "RetryUntilSuccessful")
    attempts = studio.at("port-num_attempts")
    attempts.fill("3")
    attempts.press("ArrowUp")
    expect(attempts).to_have_value("4")
    attempts.fill("{tries}")
    expect(block(studio, "RetryUntilSuccessful")).to_contain_text("{tries}")

    forward.click()
    expect(inspector(studio)).to_contain_text("Drives straight ahead.")
    speed.fill("0.3")
    speed.press("ArrowUp")
    expect(speed).to_have_value("0.4")
    speed.press("Shift+ArrowUp")
    expect(speed).to_have_value("1.4")
    speed.fill("fast")
    expect(forward).to_have_attribute("data-problem", "error")
    expect(inspector(studio)).to_contain_text("fast")
    speed.fill("0.4")
    expect(forward).not_to_have_attribute("data-problem", "error")
    inspector(studio).get_by_role("button", name="Use a blackboard key").click()
    expect(speed).to_have_value("{lin_speed}")
    speed.fill("{t")
    studio.page.get_by_role("option", name="{tries}").click()
    expect(forward).to_contain_text("{tries}")
    inspector(studio).get_by_role("button", name="Back to the default").click()
    expect(speed).to_have_value("")
    keys.press("Escape")
    inspector(studio).get_by_role("button", name="Show", exact=True).click()
    expect(studio.at("action-source")).to_contain_text("class Forward")
    studio.picture("inspector-source")
    inspector(studio).get_by_role("button", name="Hide", exact=True).click()
    inspector(studio).get_by_role("button", name="Open code").click()
    expect(studio.page.locator('[data-path="actions/Forward.py"] .cm-content')).to_be_focused()
    keys.press("Alt+t")
    focused(studio, "canvas")


def truth_choices_and_scripts(studio: Studio) -> None:
    """A truth value is a switch, a status a choice; an expression is coloured, completed and checked."""
    page, keys = studio.page, studio.page.keyboard
    block(studio, "Turn").click()
    wrap(studio, "RunOnce")
    inspector(studio).get_by_text("false", exact=True).click()
    expect(block(studio, "RunOnce")).to_contain_text("false")

    wrap(studio, "Precondition")
    expect(block(studio, "Precondition")).to_have_attribute("data-problem", "error")
    studio.at("port-else").click()
    page.get_by_role("option", name="SKIPPED").click()
    expect(block(studio, "Precondition")).to_contain_text("SKIPPED")
    script = studio.at("port-if")
    script.click()
    keys.type("tri")
    page.locator(".cm-tooltip-autocomplete li", has_text="tries").click()
    keys.type(" <")
    expect(studio.at("port-if-error")).to_be_visible()
    keys.type(" 3")
    expect(studio.at("port-if-error")).to_have_count(0)
    assert script.locator("span").count() >= 2, "names and numbers have colours"
    expect(block(studio, "Precondition")).to_contain_text("tries < 3")
    expect(block(studio, "Precondition")).not_to_have_attribute("data-problem", "error")
    for _ in range(2):
        block(studio, "Precondition" if block(studio, "Precondition").count() else "RunOnce").click()
        keys.press("Shift+Delete")
    expect(block(studio, "RunOnce")).to_have_count(0)


def conditions_are_written(studio: Studio) -> None:
    """A condition is chosen, reported as wrong, fixed, seen on the block, and removed."""
    keys = studio.page.keyboard
    forward = block(studio, "Forward")
    forward.click()
    inspector(studio).get_by_role("button", name="Add condition").click()
    studio.menu("Add condition").get_by_role("menuitem", name="Skip if").click()
    studio.at("condition-_skipIf").click()
    keys.type("tries ==")
    expect(studio.at("condition-_skipIf-error")).to_be_visible()
    expect(forward).to_have_attribute("data-problem", "error")
    keys.type(" 'none'")
    expect(studio.at("condition-_skipIf-error")).to_have_count(0)
    expect(forward).not_to_have_attribute("data-problem", "error")
    expect(forward.get_by_title("_skipIf: tries == 'none'")).to_be_visible()
    studio.picture("inspector-condition")
    inspector(studio).get_by_role("button", name="Remove Skip if").click()
    expect(forward.get_by_title("_skipIf")).to_have_count(0)


def looks_and_words(studio: Studio) -> None:
    """Name, comment, colour, and whether a block takes part; text typed without a pause is one undo step."""
    forward = block(studio, "Forward")
    studio.at("node-name").fill("ahead")
    inspector(studio).get_by_role("textbox", name="Comment").fill("until something is there")
    inspector(studio).get_by_role("button", name="#1d6fb8").click()
    inspector(studio).get_by_role("switch", name="Disabled").check(force=True)
    expect(forward).to_have_attribute("data-disabled", "true")
    expect(forward).to_contain_text("ahead")
    expect(forward.get_by_title("until something is there")).to_be_visible()
    studio.page.keyboard.press("Control+z")  # the switch has the focus: there is no text to undo
    expect(forward).not_to_have_attribute("data-disabled", "true")
    for _ in range(3):
        studio.at("undo").click()
    expect(forward).not_to_contain_text("ahead")


def one_field_takes_a_hundred_kilobytes(studio: Studio) -> None:
    """The text is stored unchanged, and the block stays small."""
    studio.at("node-name").fill("long " * 20_000)
    forward = block(studio, "Forward")
    expect(forward).to_contain_text("long")
    box = forward.bounding_box()
    assert box
    assert box["width"] < 400
    studio.saved()
    studio.page.reload()
    forward.click()
    expect(studio.at("node-name")).to_have_value(("long " * 20_000).strip())
    studio.at("node-name").fill("")
    studio.saved()


@pytest.mark.long_walk
def test_a_tree_is_looked_at_from_everywhere(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    tidy_in_both_directions(studio)
    a_moved_block_stays(studio)
    the_view_goes_to_what_is_wanted(studio)
    the_outline_is_the_same_tree(studio)
    two_thousand_blocks_are_pasted(studio)
    an_empty_tree_teaches(studio)


def tidy_in_both_directions(studio: Studio) -> None:
    """From top to bottom, from left to right, and back: no block overlaps another."""

    def lies(beyond: int) -> bool:
        start, end = place(block(studio, "ReactiveSequence")), place(block(studio, "Turn"))
        return end[beyond] > start[beyond] + start[beyond + 2]

    wait_until(lambda: lies(1), "children are below")
    studio.at("orientation").click()
    wait_until(lambda: lies(0), "children are to the right")
    block(studio, "ReactiveFallback").click()
    studio.page.keyboard.press("ArrowRight")
    assert selected(studio) == ["Inverter"], "arrows go where the eye does"
    rest(block(studio, "Turn"))
    boxes = [place(each) for each in studio.at("canvas").locator("[data-type]").all()]
    for at, (x, y, width, height) in enumerate(boxes):
        for other in boxes[at + 1 :]:
            apart = x + width <= other[0] or other[0] + other[2] <= x
            assert apart or y + height <= other[1] or other[1] + other[3] <= y, "blocks lie on each other"
    studio.at("orientation").click()
    wait_until(lambda: lies(1), "children are below again")


def a_moved_block_stays(studio: Studio) -> None:
    """A block that the user moved stays there after a reload, until the tree is tidied."""
    mouse = studio.page.mouse
    check, turn = block(studio, "CheckObstacle"), block(studio, "Turn")

    def beside() -> float:
        """Returns how far one is to the right of the other, in widths of that: the same at any zoom."""
        return (middle(check)[0] - middle(turn)[0]) / place(turn)[2]

    rest(check)
    tidy = beside()
    x, y = middle(check)
    mouse.move(x, y)
    mouse.down()
    mouse.move(x - 20, y + 30, steps=3)
    mouse.move(x - 150, y + 150, steps=5)
    mouse.up()
    wait_until(lambda: beside() < tidy - 0.5, "it lies where it was put")
    rest(check)
    own = beside()
    studio.saved()
    studio.page.reload()
    expect(check).to_be_visible()
    wait_until(lambda: abs(beside() - own) < 0.05, "it lies there after a reload")
    studio.at("tidy").click()
    wait_until(lambda: abs(beside() - tidy) < 0.05, "tidying puts it in line")
    studio.at("undo").click()
    wait_until(lambda: abs(beside() - own) < 0.05, "undo gives it its own place back")
    studio.at("tidy").click()
    wait_until(lambda: abs(beside() - tidy) < 0.05, "all is in line")


def the_view_goes_to_what_is_wanted(studio: Studio) -> None:
    """Minimap, zoom to the selection, search by names, types and ports."""
    page, keys = studio.page, studio.page.keyboard
    view = studio.at("canvas").locator(".react-flow__viewport")
    zoom = studio.at("canvas").get_by_role("button", name="Zoom to 100 %")
    page.get_by_role("button", name="Overview", exact=True).click()
    minimap = studio.at("minimap")
    rest(block(studio, "Turn"))
    before = view.get_attribute("style")
    # Towards the last blocks, which then lie beside the overview.
    minimap.click(position={"x": 130, "y": 80})
    wait_until(lambda: view.get_attribute("style") != before, "a press on the overview goes there")
    rest(block(studio, "Turn"))
    block(studio, "Turn").click()
    wait_until(partial(is_selected, studio, "Turn"), "the block is selected")
    for _ in range(3):
        page.get_by_role("button", name="Zoom out").click()
    rest(block(studio, "Turn"))  # the page ignores another change of the view during this one
    keys.press("Shift+Digit2")
    expect(zoom).to_have_text("110%")
    page.get_by_role("button", name="Overview", exact=True).click()
    expect(minimap).to_have_count(0)

    keys.press("Control+f")
    found = page.get_by_role("search")
    for text, count, first in (
        ("reactive", "1 of 2", "ReactiveSequence"),
        ("lin_speed", "1 of 1", "Forward"),
        ("nowhere", "0 of 0", "Forward"),
    ):
        found.get_by_role("textbox").fill(text)
        expect(found).to_contain_text(count)
        wait_until(partial(is_selected, studio, first), f"{first} is found")
    found.get_by_role("textbox").fill("reactive")
    keys.press("Enter")
    expect(found).to_contain_text("2 of 2")
    keys.press("Shift+Enter")
    expect(found).to_contain_text("1 of 2")
    keys.press("Escape")
    focused(studio, "canvas")
    keys.press("Shift+Digit1")


def the_outline_is_the_same_tree(studio: Studio) -> None:
    """Its lines are the blocks: walked, folded and deleted by keys, and the canvas follows."""
    page, keys = studio.page, studio.page.keyboard
    page.get_by_role("tab", name="Outline", exact=True).click()
    outline = studio.at("outline")
    lines = outline.get_by_role("treeitem")
    expect(lines).to_have_count(len(ORDER))
    lines.filter(has_text="ReactiveFallback").click()
    assert selected(studio) == ["ReactiveFallback"]
    outline.focus()
    keys.press("ArrowLeft")
    expect(lines).to_have_count(3)
    expect(block(studio, "Turn")).to_have_count(0)
    expect(block(studio, "ReactiveFallback")).to_contain_text("3 blocks")
    keys.press("ArrowRight")
    expect(block(studio, "Turn")).to_be_visible()
    keys.press("End")
    wait_until(lambda: selected(studio) == ["Forward"], "the last line is the last block")
    keys.press("Delete")
    expect(lines).to_have_count(len(ORDER) - 1)
    takes_back(studio, ORDER)
    page.get_by_role("tab", name="Explorer", exact=True).click()


def an_empty_tree_teaches(studio: Studio) -> None:
    """It says how to begin; a control without children is marked; a deleted tree is restored."""
    page, keys = studio.page, studio.page.keyboard
    studio.command("new tree")
    page.get_by_role("dialog").get_by_role("textbox").fill("Dock")
    keys.press("Enter")
    dock = page.locator("[data-testid=canvas][data-tree=Dock]")
    dock.get_by_role("button", name="Type or drop the first block").click()
    studio.writing()
    keys.type("Sequence")
    keys.press("Enter")
    expect(dock.locator("[data-type=Sequence]")).to_have_attribute(
        "data-problem", re.compile("error|warning")
    )
    studio.command("delete this file")
    expect(dock).to_have_count(0)
    page.get_by_role("button", name="Undo", exact=True).last.click()
    studio.command("open tree dock")
    expect(dock.locator("[data-type=Sequence]")).to_be_visible()
    studio.command("open tree maintree")
    expect(block(studio, "Forward")).to_be_visible()


def two_thousand_blocks_are_pasted(studio: Studio) -> None:
    """Pasted from another program's text: one undo step, and the search jumps to the last one at once."""
    row = "<Sequence>" + "<AlwaysSuccess/>" * 19 + "</Sequence>"
    paste(studio, f"<Fallback>{row * 100}</Fallback>")
    expect(block(studio, "Fallback")).to_have_count(1)
    if not studio.at("minimap").count():
        studio.page.get_by_role("button", name="Overview", exact=True).click()
    expect(studio.at("minimap")).to_be_visible()
    studio.page.get_by_role("tab", name="Outline", exact=True).click()
    studio.at("outline").focus()
    studio.page.keyboard.press("End")
    expect(studio.page.locator("#canvas-announcer")).to_contain_text("Success")
    studio.saved()
    studio.picture("two-thousand")
    takes_back(studio, ORDER)
    paste(studio, "no tree at all")
    expect(studio.page.get_by_text("no blocks", exact=False)).to_be_visible()
    studio.saved()


def is_selected(studio: Studio, node: str) -> bool:
    """Whether one block alone is selected."""
    return selected(studio) == [node]
