"""The canvas by mouse and keys: drags that are cancelled, views of small, wide and empty trees."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, children, middle, paste, place, rest, selected, takes_back
from tests.e2e.server import wait_until
from tests.e2e.studio import NOT_RUNNABLE

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]


def begin_drag(studio: Studio, start: Locator, x: float, y: float) -> None:
    """Drags from `start` to a point, and keeps the button pressed."""
    mouse, at = studio.page.mouse, middle(start)
    mouse.move(*at)
    mouse.down()
    mouse.move(at[0] + 20, at[1] + 5, steps=3)
    mouse.move(x, y, steps=6)


def test_escape_cancels_every_drag(studio: Studio) -> None:
    """After Escape or the right button the tree is as before, and there is nothing to undo."""
    studio.new_from("laser_bump_and_go")
    rest(block(studio, "Turn"))
    whole = children(studio)
    blocks_stay_where_they_are(studio, whole)
    a_copy_has_a_ghost(studio, whole)
    no_connection_is_made(studio)
    the_frame_selects_nothing(studio)
    panes_keep_their_sizes(studio)
    assert children(studio) == whole
    expect(studio.at("undo")).to_be_disabled()


def blocks_stay_where_they_are(studio: Studio, whole: list[str]) -> None:
    mouse, forward = studio.page.mouse, block(studio, "Forward")
    x, y = middle(block(studio, "ReactiveFallback"))
    before = place(forward)
    for cancel in ("Escape", "right"):
        begin_drag(studio, forward, x - 110, y)
        expect(studio.at("insertion-mark")).to_be_visible()
        if cancel == "right":
            mouse.down(button="right")
            mouse.up(button="right")
        else:
            studio.page.keyboard.press(cancel)
        expect(studio.at("insertion-mark")).to_have_count(0)
        mouse.move(x - 90, y + 40)
        mouse.up()
        expect(studio.page.get_by_role("menu")).to_have_count(0)
        assert place(forward) == before
        assert children(studio) == whole
    expect(studio.at("undo")).to_be_disabled()


def a_copy_has_a_ghost(studio: Studio, whole: list[str]) -> None:
    """With Alt the block stays; the drop makes the copy, which is one step of undo."""
    keys, mouse, forward = studio.page.keyboard, studio.page.mouse, block(studio, "Forward")
    ghost = studio.at("copy-ghost")
    x, y = middle(forward)
    before = place(forward)
    for ending in ("Escape", "drop"):
        keys.down("Alt")
        begin_drag(studio, forward, x + 40, y + 150)
        expect(ghost).to_contain_text("+")
        assert place(forward) == before
        if ending == "Escape":
            keys.press("Escape")
        else:
            studio.picture("copy-ghost")
        mouse.up()
        keys.up("Alt")
        expect(ghost).to_have_count(0)
        expect(forward).to_have_count(1 if ending == "Escape" else 2)
    takes_back(studio, whole)
    expect(studio.at("undo")).to_be_disabled()


def no_connection_is_made(studio: Studio) -> None:
    node = studio.page.locator(".react-flow__node:has([data-type=ReactiveFallback])")
    x, y = middle(block(studio, "Forward"))
    begin_drag(studio, node.locator(".react-flow__handle.source"), x, y + 150)
    line = studio.at("canvas").locator(".react-flow__connection")
    expect(line).to_be_visible()
    studio.page.keyboard.press("Escape")
    expect(line).to_have_count(0)
    studio.page.mouse.up()
    expect(studio.at("quick-add")).to_have_count(0)


def the_frame_selects_nothing(studio: Studio) -> None:
    """The selection stays as it was before."""
    keys, mouse = studio.page.keyboard, studio.page.mouse
    block(studio, "Forward").click()
    start, end = place(block(studio, "Inverter")), place(block(studio, "Turn"))
    keys.down("Shift")
    mouse.move(start[0] - 25, start[1] - 15)
    mouse.down()
    mouse.move(end[0] + 20, end[1] + 20, steps=6)
    wait_until(lambda: selected(studio) == ["Inverter", "Turn"], "the frame selects what it touches")
    keys.press("Escape")
    wait_until(lambda: selected(studio) == ["Forward"], "the selection is as before")
    mouse.move(end[0] + 40, end[1] + 20)
    mouse.up()
    keys.up("Shift")
    assert selected(studio) == ["Forward"]
    turn = block(studio, "Turn")
    turn.click()
    assert selected(studio) == ["Turn"], "the next press counts"


def panes_keep_their_sizes(studio: Studio) -> None:
    canvas = studio.at("canvas")
    before = place(canvas)
    lines = studio.page.locator(".flexlayout__splitter").all()
    # The line on the left of the canvas.
    splitter = min(lines, key=lambda line: abs(middle(line)[0] - before[0]))
    x, y = middle(splitter)
    mouse = studio.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 120, y + 60, steps=5)
    wait_until(lambda: place(canvas) != before, "the panels are resized on the way")
    studio.page.keyboard.press("Escape")
    wait_until(lambda: place(canvas) == before, "they are as before")
    mouse.move(x + 160, y + 60)
    mouse.up()
    assert place(canvas) == before


def test_an_empty_project_begins_with_a_ghost(studio: Studio) -> None:
    """No error until Run is pressed, which says what is missing; a drop and a key begin the tree."""
    keys = studio.page.keyboard
    studio.at("new-from-empty").click()
    ghost = studio.at("ghost-block")
    expect(ghost).to_have_text("Type or drop the first block")
    studio.saved()
    problems = studio.page.locator(".flexlayout__tab_button", has_text="Problems")
    expect(problems.locator("[data-severity]")).to_have_count(0)
    studio.picture("empty-project")
    studio.may_be_refused(NOT_RUNNABLE)
    studio.at("run").click()
    expect(studio.at("banner")).to_contain_text("there is nothing to run")
    expect(studio.at("banner")).to_contain_text("Drop a block from the palette")
    expect(problems.locator("[data-severity=error]")).to_have_count(1)
    studio.at("palette-Sequence").drag_to(ghost)
    expect(block(studio, "Sequence")).to_be_visible()
    expect(ghost).to_have_count(0)
    keys.press("Control+z")
    expect(ghost).to_be_visible()
    keys.type("fallb")
    expect(studio.at("quick-add")).to_be_visible()
    keys.press("Enter")
    expect(block(studio, "Fallback")).to_be_visible()


def test_a_wide_tree_is_seen_as_a_whole(studio: Studio) -> None:
    """Show the whole tree, the compact layout, levels, and a new block beside the overview."""
    studio.at("new-from-empty").click()
    canvas = studio.at("canvas")
    expect(canvas).to_be_focused()
    row = "<Sequence>" + "<AlwaysSuccess/>" * 19 + "</Sequence>"
    paste(studio, f"<Fallback>{row * 30}</Fallback>")
    expect(block(studio, "Fallback")).to_have_count(1)
    studio.page.keyboard.press("Shift+Digit1")
    expect(block(studio, "AlwaysSuccess")).to_have_count(30 * 19)
    expect(canvas).to_have_attribute("data-far", "true")
    wait_until(lambda: is_within(studio, "AlwaysSuccess"), "all blocks are in view")
    wide = zoom(studio)
    studio.at("compact").click()
    wait_until(lambda: zoom(studio) > wide, "the compact tree is seen larger")
    wait_until(lambda: is_within(studio, "AlwaysSuccess"), "all are in view again")
    studio.picture("compact-tree")
    studio.page.reload()
    expect(studio.at("compact")).to_have_attribute("aria-pressed", "true")
    studio.at("compact").click()
    wait_until(lambda: zoom(studio) == wide, "the whole tree is seen again")
    studio.command("collapse to level 1")
    expect(block(studio, "AlwaysSuccess")).to_have_count(0)
    expect(block(studio, "Sequence").first).to_be_visible()
    studio.command("unfold all levels")
    # Its blocks are dots now: a key selects the root.
    canvas.focus()
    studio.page.keyboard.press("Home")
    wait_until(lambda: selected(studio) == ["Fallback"], "the root is selected")
    a_new_block_is_not_hidden(studio)


def a_new_block_is_not_hidden(studio: Studio) -> None:
    """Neither below the overview nor outside: the view moves just so far."""
    keys, added = studio.page.keyboard, block(studio, "Sleep")
    keys.press("Shift+Digit2")
    wait_until(lambda: zoom(studio) == 110, "the selection is seen large")
    rest(block(studio, "Fallback"))
    keys.press("Tab")
    studio.writing()
    keys.type("Sleep")
    keys.press("Enter")
    expect(added).to_be_visible()
    rest(added)
    x, y, width, height = place(added)
    map_x, map_y, *_ = place(studio.at("minimap"))
    view_x, view_y, view_width, view_height = place(studio.at("canvas"))
    assert x + width <= map_x or y + height <= map_y, "it lies beside the overview"
    assert view_x <= x
    assert x + width <= view_x + view_width
    assert view_y <= y
    assert y + height <= view_y + view_height


def test_a_small_canvas_has_one_button(studio: Studio) -> None:
    """At 390 px the tools are one button, and the tree is fitted beside it."""
    studio.new_from("laser_bump_and_go")
    rest(block(studio, "Turn"))
    studio.page.set_viewport_size({"width": 390, "height": 844})
    toggle = studio.at("toolbar-toggle")
    expect(toggle).to_be_visible()
    expect(studio.at("tidy")).to_have_count(0)
    wait_until(lambda: is_within(studio, "ReactiveSequence"), "the tree is fitted again")
    rest(block(studio, "ReactiveSequence"))
    root, tools = place(block(studio, "ReactiveSequence")), place(toggle)
    assert root[1] + root[3] <= tools[1] or root[0] >= tools[0] + tools[2], "the root is not below it"
    studio.picture("narrow-canvas")
    toggle.click()
    expect(studio.at("tidy")).to_be_visible()
    toggle.click()
    expect(studio.at("tidy")).to_have_count(0)


def test_a_menu_over_several_blocks(studio: Studio) -> None:
    """It offers what works on all of them."""
    studio.new_from("laser_bump_and_go")
    whole = ["ReactiveSequence", "ReactiveFallback", "Forward", "Inverter", "Turn", "CheckObstacle"]
    block(studio, "Inverter").click()
    block(studio, "Turn").click(modifiers=["Control"])
    block(studio, "Turn").click(button="right")
    for words in ("rename", "morph", "addAfter"):
        expect(studio.at(f"menu-{words}")).to_have_count(0)
    for words in ("cut", "copy", "duplicate", "delete", "disable", "extract", "wrapFallback"):
        expect(studio.at(f"menu-{words}")).to_be_visible()
    studio.at("menu-wrapSequence").click()
    expect(block(studio, "Sequence")).to_have_attribute("data-selected", "true")
    takes_back(studio, whole)


def test_lines_of_the_outline_are_dragged(studio: Studio) -> None:
    """A line goes before another; Escape leaves it where it was."""
    studio.new_from("laser_bump_and_go")
    rest(block(studio, "Turn"))
    whole = children(studio)
    studio.page.get_by_role("tab", name="Outline", exact=True).click()
    lines = studio.at("outline").get_by_role("treeitem")
    forward = lines.filter(has_text="Forward")
    x, y, _, height = place(lines.filter(has_text="ReactiveFallback"))
    for ending in ("Escape", "drop"):
        begin_drag(studio, forward, x + 40, y + height * 0.1)
        expect(studio.at("outline").locator("[data-mark=before]")).to_have_count(1)
        if ending == "Escape":
            studio.page.keyboard.press("Escape")
            expect(studio.at("outline").locator("[data-mark]")).to_have_count(0)
        studio.page.mouse.up()
        if ending == "Escape":
            assert children(studio) == whole
    wait_until(lambda: children(studio)[1] == "Forward", "the block goes before its sibling")
    takes_back(studio, whole)


def zoom(studio: Studio) -> int:
    button = studio.at("canvas").get_by_role("button", name="Zoom to 100 %")
    return int((button.text_content() or "0").rstrip("%"))


def is_within(studio: Studio, type_: str) -> bool:
    """Whether all blocks of a type are in the canvas."""
    return bool(
        studio.at("canvas").evaluate(
            """(canvas, type) => {
              const view = canvas.getBoundingClientRect();
              return [...canvas.querySelectorAll(`[data-type=${type}]`)].every((block) => {
                const { left, top, right, bottom } = block.getBoundingClientRect();
                return left >= view.left && top >= view.top && right <= view.right && bottom <= view.bottom;
              });
            }""",
            type_,
        )
    )
