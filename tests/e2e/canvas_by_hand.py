"""Mouse and keyboard on the blocks of a canvas, with undo after each change."""

from __future__ import annotations

from typing import TYPE_CHECKING

from playwright.sync_api import expect

from tests.e2e.server import wait_until
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from playwright.sync_api import Locator


def block(studio: Studio, type_: str) -> Locator:
    return studio.at("canvas").locator(f"[data-type={type_}]")


def children(studio: Studio) -> list[str]:
    """Returns the types of the tree's blocks from left to right, row by row, as they are read."""
    # All in one query: the view may still move to a block.
    boxes = (
        studio.at("canvas")
        .locator("[data-type]")
        .evaluate_all(
            """(blocks) => blocks.map((block) => {
          const { x, y } = block.getBoundingClientRect();
          return [y, x, block.dataset.type];
        })"""
        )
    )
    return [str(type_) for _, _, type_ in sorted(boxes)]


def middle(locator: Locator) -> tuple[float, float]:
    """Returns the centre of an element, in pixels of the window."""
    box = locator.bounding_box()
    assert box
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


# The number of consecutive frames that show an element at the same place.
STILL = """element => new Promise(done => {
  let [before, count] = ['', 0];
  const look = () => {
    const now = JSON.stringify(element.getBoundingClientRect());
    count = now === before ? count + 1 : 0;
    before = now;
    if (count < 8) requestAnimationFrame(look);
    else done(true);
  };
  look();
})"""


def rest(locator: Locator) -> None:
    """Waits until an element does not move any more: the view may still move to a block."""
    locator.evaluate(STILL)


def place(locator: Locator) -> tuple[float, float, float, float]:
    box = locator.bounding_box()
    assert box
    return box["x"], box["y"], box["width"], box["height"]


def drag(studio: Studio, start: Locator, x: float, y: float, *, is_marked: bool = False) -> None:
    """Drags from `start` to a point; `is_marked`: a mark shows the drop position."""
    mouse, at = studio.page.mouse, middle(start)
    mouse.move(*at)
    mouse.down()
    mouse.move(at[0] + 20, at[1] + 5, steps=3)
    mouse.move(x, y, steps=6)
    if is_marked:
        expect(studio.at("insertion-mark")).to_be_visible()
    mouse.up()


def paste(studio: Studio, text: str) -> None:
    """Presses Ctrl+V with this text on the clipboard."""
    studio.at("canvas").evaluate(
        """(canvas, text) => {
            const clipboardData = new DataTransfer();
            clipboardData.setData('text/plain', text);
            const how = {clipboardData, bubbles: true, cancelable: true};
            canvas.focus();
            canvas.dispatchEvent(new ClipboardEvent('paste', how));
        }""",
        text,
    )


def focused(studio: Studio, test_id: str) -> None:
    expect(studio.at(test_id)).to_be_focused()


def wrap(studio: Studio, type_: str) -> None:
    """Wraps the selected blocks in a new one by keys; the new block is selected then."""
    studio.page.keyboard.press("Control+g")
    studio.writing()
    studio.page.keyboard.type(type_)
    studio.page.keyboard.press("Enter")
    expect(block(studio, type_)).to_have_attribute("data-selected", "true")


def the_tree_is_changed_by_hand(studio: Studio) -> None:
    """All changes of blocks on the canvas; undo reverts each."""
    page, keys = studio.page, studio.page.keyboard
    whole = children(studio)
    blocks_are_dragged(studio, whole)
    several_blocks_in_one_hand(studio, whole)
    menu_and_keys(studio, whole)
    comment_and_menu_by_keys(studio, whole)
    several_blocks_at_once(studio, whole)
    a_piece_goes_to_another_project(studio)

    block(studio, "Turn").click()
    keys.press("Control+f")
    studio.writing()
    keys.type("forw")
    keys.press("Enter")
    expect(page.locator("#canvas-announcer")).to_contain_text("Forward")
    keys.press("Escape")
    for _ in range(6):
        page.get_by_role("button", name="Zoom out").click()
    expect(studio.at("canvas")).to_have_attribute("data-far", "true")
    studio.at("canvas").focus()
    keys.press("Shift+Digit1")
    expect(studio.at("canvas")).not_to_have_attribute("data-far", "true")
    studio.saved()


def takes_back(studio: Studio, whole: list[str]) -> None:
    studio.at("undo").click()
    wait_until(lambda: children(studio) == whole, "undo brings the tree back")


def blocks_are_dragged(studio: Studio, whole: list[str]) -> None:
    """Drags before a sibling, onto a parent, as a copy, and a connection that ends nowhere."""
    forward, fallback = block(studio, "Forward"), block(studio, "ReactiveFallback")
    x, y = middle(fallback)
    drag(studio, forward, x - 110, y, is_marked=True)
    wait_until(lambda: children(studio)[1:3] == ["Forward", "ReactiveFallback"], "it goes before its sibling")
    takes_back(studio, whole)
    drag(studio, forward, x, y)
    wait_until(lambda: children(studio)[2:5] == ["Inverter", "Turn", "Forward"], "it goes below the other")
    takes_back(studio, whole)
    x, y = middle(forward)
    studio.page.keyboard.down("Alt")
    drag(studio, forward, x + 40, y + 150)
    studio.page.keyboard.up("Alt")
    expect(forward).to_have_count(2)
    takes_back(studio, whole)
    node = studio.page.locator(".react-flow__node:has([data-type=ReactiveFallback])")
    drag(studio, node.locator(".react-flow__handle.source"), x, y + 150)
    studio.writing()
    studio.page.keyboard.type("AlwaysFailure")
    studio.page.keyboard.press("Enter")
    expect(block(studio, "AlwaysFailure")).to_be_visible()
    takes_back(studio, whole)


def several_blocks_in_one_hand(studio: Studio, whole: list[str]) -> None:
    """Blocks dragged together keep their order; a parent with room for one takes no two, also as copies."""
    keys = studio.page.keyboard
    inverter, turn, forward = (block(studio, type_) for type_ in ("Inverter", "Turn", "Forward"))
    inverter.click()
    turn.click(modifiers=["Control"])
    rest(turn)
    x, y = middle(forward)
    drag(studio, turn, x + 110, y)
    row = ["ReactiveFallback", "Forward", "Inverter", "Turn"]
    wait_until(lambda: children(studio)[1:5] == row, "both go to the end")
    keys.press("Shift+Digit1")  # the row is wider than the canvas now
    rest(turn)
    x, y = middle(block(studio, "ReactiveFallback"))
    drag(studio, turn, x - 90, y)
    wait_until(lambda: children(studio)[1:5] == row[2:] + row[:2], "both go to the beginning")
    keys.press("Control+ArrowRight")
    wait_until(lambda: children(studio)[1:5] == [row[0], *row[2:], row[1]], "keys move both, too")
    keys.press("Control+z")
    studio.at("undo").click()
    takes_back(studio, whole)
    check = block(studio, "CheckObstacle")
    rest(check)
    keys.down("Alt")
    drag(studio, check, middle(check)[0] + 90, middle(check)[1])
    keys.up("Alt")
    expect(check).to_have_count(2)
    expect(inverter).not_to_have_attribute("data-problem", "error")
    expect(check.and_(studio.page.locator("[data-draft]"))).to_have_count(1)
    takes_back(studio, whole)
    rest(inverter)
    studio.at("palette-Forward").drag_to(inverter)
    wait_until(lambda: children(studio)[3:6] == ["Forward", "Inverter", "Turn"], "a new one goes beside it")
    takes_back(studio, whole)


def menu_and_keys(studio: Studio, whole: list[str]) -> None:
    """Wrap, disable, comment, cut and paste; a part becomes a tree, is opened, and is inlined again."""
    keys = studio.page.keyboard
    forward = block(studio, "Forward")
    forward.click()
    wrap(studio, "Repeat")
    takes_back(studio, whole)
    forward.click()
    keys.press("Control+e")
    expect(forward).to_have_attribute("data-disabled", "true")
    takes_back(studio, whole)
    forward.click()
    keys.press("Control+x")
    expect(forward).to_have_count(0)
    takes_back(studio, whole)
    forward.click()
    keys.press("Control+c")
    block(studio, "Turn").click()
    keys.press("Control+v")
    wait_until(lambda: children(studio)[3:6] == ["Inverter", "Turn", "Forward"], "it is pasted after a leaf")
    takes_back(studio, whole)
    block(studio, "ReactiveFallback").click()
    keys.type("sleep")  # a letter on a block opens the box with it
    expect(studio.at("quick-add")).to_be_visible()
    keys.press("Enter")
    expect(block(studio, "Sleep")).to_be_visible()
    takes_back(studio, whole)
    block(studio, "ReactiveFallback").click(button="right")
    studio.page.get_by_role("menuitem", name="Extract").click()
    call = block(studio, "SubTree")
    expect(block(studio, "Turn")).to_have_count(0)
    call.click()
    keys.press("Space")
    expect(block(studio, "Turn")).to_be_visible()
    keys.press("Space")
    expect(block(studio, "Turn")).to_have_count(0)
    call.click(button="right")
    studio.page.get_by_role("menuitem", name="Inline").click()
    wait_until(lambda: children(studio) == whole, "the piece is back in the tree")


def selected(studio: Studio) -> list[str]:
    """Returns the types of the selected blocks."""
    shown = studio.at("canvas").locator("[data-selected][data-type]")
    return sorted(str(each.get_attribute("data-type")) for each in shown.all())


def comment_and_menu_by_keys(studio: Studio, whole: list[str]) -> None:
    """`/` writes a comment, Shift+Delete removes a block around its child, Shift+F10 opens the menu."""
    keys = studio.page.keyboard
    forward = block(studio, "Forward")
    forward.click()
    keys.press("/")
    studio.writing()
    keys.type("as long as the way is free")
    keys.press("Enter")
    expect(forward.get_by_title("as long as the way is free")).to_be_visible()
    focused(studio, "canvas")
    studio.at("undo").click()
    block(studio, "Inverter").click()
    keys.press("Shift+Delete")
    expect(block(studio, "Inverter")).to_have_count(0)
    expect(block(studio, "CheckObstacle")).to_be_visible()
    takes_back(studio, whole)
    block(studio, "ReactiveFallback").click()
    keys.press("Shift+F10")
    expect(studio.at("menu-addChild")).to_be_focused()
    keys.press("ArrowDown")
    expect(studio.at("menu-addChild")).not_to_be_focused()
    keys.press("ArrowUp")
    expect(studio.at("menu-addChild")).to_be_focused()
    assert selected(studio) == ["ReactiveFallback"], "the menu's keys are not the tree's"
    keys.press("Escape")
    focused(studio, "canvas")
    assert selected(studio) == ["ReactiveFallback"]


def several_blocks_at_once(studio: Studio, whole: list[str]) -> None:
    """Several blocks, selected by a frame or Ctrl: deleted, wrapped, made a tree; breadcrumbs lead out."""
    page, keys = studio.page, studio.page.keyboard
    inverter, turn = block(studio, "Inverter"), block(studio, "Turn")
    start, end = inverter.bounding_box(), turn.bounding_box()
    assert start
    assert end
    keys.down("Shift")
    page.mouse.move(start["x"] - 25, start["y"] - 15)
    page.mouse.down()
    page.mouse.move(end["x"] + 20, end["y"] + 20, steps=6)
    page.mouse.up()
    keys.up("Shift")
    wait_until(lambda: selected(studio) == ["Inverter", "Turn"], "the frame selects what it touches")
    keys.press("Delete")
    expect(turn).to_have_count(0)
    expect(block(studio, "CheckObstacle")).to_have_count(0)
    takes_back(studio, whole)

    turn.click()
    wait_until(lambda: selected(studio) == ["Turn"], "a press means one")
    inverter.click(modifiers=["Control"])
    wrap(studio, "Sequence")
    takes_back(studio, whole)
    several_are_disabled(studio)
    inverter.click()
    turn.click(modifiers=["Control"])
    turn.click(button="right")
    page.get_by_role("menuitem", name="Extract").click()
    expect(turn).to_have_count(0)
    keys.press("Enter")
    inside = page.locator("[data-testid=canvas]:visible")
    expect(inside.locator("[data-type=ReactiveFallback]")).to_be_visible()
    inside.locator("[data-type=ReactiveFallback]").click()
    keys.press("Tab")
    studio.writing()
    keys.type("MainTree")  # a tree within itself is not offered
    expect(studio.at("quick-add").get_by_role("option").first).to_contain_text("New action")
    keys.press("Escape")
    inside.locator("[data-type=Turn]").click()
    way = inside.get_by_role("navigation").get_by_role("button")
    expect(way).to_have_text(["MainTree", "TurnTree", "ReactiveFallback", "Turn"])
    way.nth(2).click()
    expect(inside.locator("[data-selected][data-type]")).to_have_attribute("data-type", "ReactiveFallback")
    expect(inside).to_be_focused()
    way.first.click()
    expect(block(studio, "SubTree")).to_be_visible()
    takes_back(studio, whole)
    expect(page.get_by_role("tab", name="TurnTree")).to_have_count(0)


def several_are_disabled(studio: Studio) -> None:
    """The inspector lists the commands for several blocks."""
    block(studio, "Inverter").click()
    block(studio, "Turn").click(modifiers=["Control"])
    expect(studio.at("inspector")).to_contain_text("2 blocks selected")
    studio.at("inspector").get_by_role("button", name="Disable").click()
    disabled = studio.at("canvas").locator("[data-type][data-disabled]")
    expect(disabled).to_have_count(2)
    studio.at("undo").click()
    expect(disabled).to_have_count(0)


def a_piece_goes_to_another_project(studio: Studio) -> None:
    """Copied here, pasted there with its action; the lamp on a block whose action is missing creates it."""
    block(studio, "Inverter").click()
    studio.page.keyboard.press("Control+c")
    page = studio.page.context.new_page()
    page.goto(studio.server.origin)
    page.get_by_test_id("new-from-empty").click()
    canvas = page.get_by_test_id("canvas")
    expect(canvas).to_be_focused()
    page.keyboard.press("Control+v")
    page.get_by_test_id("take-arrivals").click()
    check = canvas.locator("[data-type=CheckObstacle]")
    expect(check).to_be_visible()
    expect(check).not_to_have_attribute("data-problem", "error")
    expect(page.get_by_test_id("file-actions/CheckObstacle.py")).to_be_visible()
    page.keyboard.press("Control+z")
    expect(check).to_have_count(0)
    paste(Studio(page, studio.server), "<Unwritten/>")
    unwritten = canvas.locator("[data-type=Unwritten]")
    expect(unwritten).to_have_attribute("data-problem", "error")
    unwritten.get_by_test_id("problem-mark").click()
    page.get_by_test_id("fix-box").get_by_role("button", name="Write the action").click()
    expect(unwritten).not_to_have_attribute("data-problem", "error")
    expect(page.get_by_test_id("file-actions/Unwritten.py")).to_be_visible()
    page.close()
