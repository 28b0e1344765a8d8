"""*Bump and go* from an empty project: by keyboard alone, and by mouse alone but for names and code."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

EXAMPLE = Path(__file__).parents[2] / "examples" / "laser_bump_and_go" / "actions"
ACTIONS = ("CheckObstacle", "Turn", "Forward")


def source(action: str) -> str:
    return (EXAMPLE / f"{action}.py").read_text(encoding="utf-8")


def block(studio: Studio, type_: str) -> Locator:
    return studio.at("canvas").locator(f"[data-type={type_}]")


def children(studio: Studio) -> list[str]:
    """The types of the tree's blocks from left to right, row by row, as the eye reads them."""
    # All in one look: the view may still be on its way to a block.
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


def focused(studio: Studio, test_id: str) -> None:
    expect(studio.at(test_id)).to_be_focused()


def quick(studio: Studio, key: str, name: str) -> None:
    """Opens the quick-add box and chooses the first that is found."""
    studio.page.keyboard.press(key)
    expect(studio.at("quick-add")).to_be_visible()
    studio.page.keyboard.type(name)
    studio.page.keyboard.press("Enter")
    expect(studio.at("quick-add")).to_have_count(0)
    focused(studio, "canvas")


def write_code(studio: Studio, action: str) -> None:
    """From a block to its code and back, by keys."""
    studio.page.keyboard.press("Enter")
    editor = studio.page.locator(f'[data-path="actions/{action}.py"] .cm-content')
    expect(editor).to_be_focused()
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.insert_text(source(action))
    studio.page.keyboard.press("Alt+t")
    focused(studio, "canvas")


def test_by_keyboard_alone(shared_studio: Studio) -> None:
    studio, keys = shared_studio, shared_studio.page.keyboard
    template = studio.at("new-from-empty")
    for _ in range(40):
        if template.evaluate("element => element === document.activeElement"):
            break
        keys.press("Tab")
    keys.press("Enter")
    focused(studio, "canvas")

    keys.press("Home")
    quick(studio, "Control+m", "ReactiveSequence")
    quick(studio, "Tab", "ReactiveFallback")
    quick(studio, "Tab", "Inverter")
    quick(studio, "Tab", "CheckObstacle")
    write_code(studio, "CheckObstacle")
    keys.press("ArrowUp")
    quick(studio, "Control+Enter", "Turn")
    write_code(studio, "Turn")
    keys.press("ArrowUp")
    quick(studio, "Control+Enter", "Forward")
    write_code(studio, "Forward")
    assert children(studio) == [
        "ReactiveSequence",
        "ReactiveFallback",
        "Forward",
        "Inverter",
        "Turn",
        "CheckObstacle",
    ]
    studio.saved()
    ports_names_and_order_by_keys(studio)
    dialogues_by_keys(studio)

    keys.press("F5")
    studio.expect_state("application_running")
    observer = studio.observe()
    wait_until(lambda: observer.distance_travelled("robot") > 0.5, "the robot drives")
    observer.close()
    studio.at("end-session").click()
    studio.expect_state("idle")


def ports_names_and_order_by_keys(studio: Studio) -> None:
    """A port, a name, another place and back, without leaving the keyboard."""
    keys = studio.page.keyboard
    keys.press("F4")
    focused(studio, "port-lin_speed")
    keys.type("0.4")
    keys.press("Escape")
    focused(studio, "canvas")
    keys.press("F2")
    keys.type("go on")
    keys.press("Enter")
    expect(block(studio, "Forward")).to_contain_text("go on")
    focused(studio, "canvas")
    keys.press("Control+ArrowLeft")
    wait_until(lambda: children(studio)[1] == "Forward", "the block goes before its sibling")
    keys.press("Control+z")
    wait_until(lambda: children(studio)[1] == "ReactiveFallback", "undo brings it back")
    studio.saved()


def dialogues_by_keys(studio: Studio) -> None:
    """Each opens with the focus in it, at what is wanted first; Escape gives it back to the tree."""
    page, keys = studio.page, studio.page.keyboard
    dialogue = page.get_by_role("dialog")
    wanted = {
        "new action": dialogue.get_by_role("textbox"),
        "new universe": page.get_by_test_id("new-universe-name"),
        "universe and robot": dialogue.get_by_role("radio", checked=True).first,
        "keyboard shortcuts": dialogue.get_by_role("button", name="Close"),
    }
    for name, first in wanted.items():
        keys.press("Control+k")
        expect(studio.at("command-palette").get_by_role("combobox")).to_be_focused()
        keys.type(name)
        keys.press("Enter")
        expect(first).to_be_focused()
        keys.press("Escape")
        expect(dialogue).to_have_count(0)
        focused(studio, "canvas")


def test_by_mouse(shared_studio: Studio) -> None:
    studio = shared_studio
    studio.at("new-from-empty").click()
    expect(block(studio, "Sequence")).to_be_visible()
    for action in ACTIONS:
        new_action(studio, action)
    studio.at("file-trees/MainTree.json").click()
    expect(studio.at("canvas")).to_be_visible()

    block(studio, "Sequence").click()
    studio.page.get_by_role("button", name="Change type").click()
    studio.at("quick-add").get_by_text("ReactiveSequence", exact=True).click()
    for block_type, onto in (
        ("ReactiveFallback", "ReactiveSequence"),
        ("Inverter", "ReactiveFallback"),
        ("CheckObstacle", "Inverter"),
        ("Turn", "ReactiveFallback"),
        ("Forward", "ReactiveSequence"),
    ):
        studio.at(f"palette-{block_type}").drag_to(block(studio, onto))
        expect(block(studio, block_type)).to_be_visible()
        studio.at("tidy").click()
    assert children(studio)[:3] == ["ReactiveSequence", "ReactiveFallback", "Forward"]
    studio.at("undo").click()
    studio.at("redo").click()
    studio.saved()
    for scheme in ("dark", "light"):
        expect_accessible(studio, scheme)
        studio.picture(f"built-{scheme}")

    the_tree_is_changed_by_hand(studio)
    fault_is_found_and_mended(studio)
    package_is_taken_away(studio)
    behaviour_is_reused(studio)
    world_is_chosen(studio)


def the_tree_is_changed_by_hand(studio: Studio) -> None:
    """Everything that the canvas does to blocks; undo takes each of it back."""
    page, keys = studio.page, studio.page.keyboard
    whole = children(studio)
    blocks_are_dragged(studio, whole)
    menu_and_keys(studio, whole)
    comment_and_menu_by_keys(studio, whole)
    several_blocks_at_once(studio, whole)
    a_piece_goes_to_another_project(studio)

    block(studio, "Turn").click()
    keys.press("Control+f")
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
    """Before a sibling, onto a parent, as a copy, and a connection that ends nowhere."""
    mouse = studio.page.mouse

    def middle(locator: Locator) -> tuple[float, float]:
        box = locator.bounding_box()
        assert box
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag(start: Locator, x: float, y: float) -> None:
        at = middle(start)
        mouse.move(*at)
        mouse.down()
        mouse.move(at[0] + 20, at[1] + 5, steps=3)
        mouse.move(x, y, steps=6)
        mouse.up()

    forward, fallback = block(studio, "Forward"), block(studio, "ReactiveFallback")
    x, y = middle(fallback)
    drag(forward, x - 110, y)
    wait_until(lambda: children(studio)[1:3] == ["Forward", "ReactiveFallback"], "it goes before its sibling")
    takes_back(studio, whole)
    drag(forward, x, y)
    wait_until(lambda: children(studio)[2:5] == ["Inverter", "Turn", "Forward"], "it goes below the other")
    takes_back(studio, whole)
    x, y = middle(forward)
    studio.page.keyboard.down("Alt")
    drag(forward, x + 40, y + 150)
    studio.page.keyboard.up("Alt")
    expect(forward).to_have_count(2)
    takes_back(studio, whole)
    node = studio.page.locator(".react-flow__node:has([data-type=ReactiveFallback])")
    drag(node.locator(".react-flow__handle.source"), x, y + 150)
    expect(studio.at("quick-add")).to_be_visible()
    studio.page.keyboard.type("AlwaysFailure")
    studio.page.keyboard.press("Enter")
    expect(block(studio, "AlwaysFailure")).to_be_visible()
    takes_back(studio, whole)


def menu_and_keys(studio: Studio, whole: list[str]) -> None:
    """Wrap, disable, comment, cut and paste; a piece becomes a tree, is looked into, and comes back."""
    keys = studio.page.keyboard
    forward = block(studio, "Forward")
    forward.click()
    keys.press("Control+g")
    keys.type("Repeat")
    keys.press("Enter")
    expect(block(studio, "Repeat")).to_be_visible()
    takes_back(studio, whole)
    forward.click()
    keys.press("Control+e")
    expect(forward).to_have_attribute("data-disabled", "true")
    takes_back(studio, whole)
    forward.click()
    keys.press("Control+x")
    expect(forward).to_have_count(0)
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
    """The types of the selected blocks."""
    shown = studio.at("canvas").locator("[data-selected][data-type]")
    return sorted(str(each.get_attribute("data-type")) for each in shown.all())


def comment_and_menu_by_keys(studio: Studio, whole: list[str]) -> None:
    """`/` writes a comment, Shift+Delete takes a block from round its child, Shift+F10 opens the menu."""
    keys = studio.page.keyboard
    forward = block(studio, "Forward")
    forward.click()
    keys.press("/")
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
    expect(studio.at("menu-addChild")).to_be_visible()
    keys.press("ArrowDown")
    expect(studio.at("menu-addChild")).to_be_focused()
    assert selected(studio) == ["ReactiveFallback"], "the menu's keys are not the tree's"
    keys.press("Escape")
    focused(studio, "canvas")
    assert selected(studio) == ["ReactiveFallback"]


def several_blocks_at_once(studio: Studio, whole: list[str]) -> None:
    """Chosen by a frame or by Ctrl: deleted, wrapped, made a tree, which the crumbs lead out of."""
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
    keys.press("Control+g")
    keys.type("Sequence")
    keys.press("Enter")
    expect(block(studio, "Sequence")).to_be_visible()
    takes_back(studio, whole)
    inverter.click()
    turn.click(modifiers=["Control"])
    turn.click(button="right")
    page.get_by_role("menuitem", name="Extract").click()
    expect(turn).to_have_count(0)
    keys.press("Enter")
    inside = page.locator("[data-testid=canvas]:visible")
    expect(inside.locator("[data-type=ReactiveFallback]")).to_be_visible()
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


def a_piece_goes_to_another_project(studio: Studio) -> None:
    """Copied here, pasted there, where its action is missing: the lamp on the block writes it."""
    block(studio, "Inverter").click()
    studio.page.keyboard.press("Control+c")
    page = studio.page.context.new_page()
    page.goto(studio.server.origin)
    page.get_by_test_id("new-from-empty").click()
    canvas = page.get_by_test_id("canvas")
    canvas.locator("[data-type=Sequence]").click()
    page.keyboard.press("Control+v")
    check = canvas.locator("[data-type=CheckObstacle]")
    expect(check).to_have_attribute("data-problem", "error")
    check.get_by_test_id("problem-mark").click()
    page.get_by_test_id("fix-box").get_by_role("button", name="Write the action").click()
    expect(check).not_to_have_attribute("data-problem", "error")
    expect(page.get_by_test_id("file-actions/CheckObstacle.py")).to_be_visible()
    page.close()


def new_action(studio: Studio, action: str) -> None:
    """Makes an action from the explorer, and types its code."""
    studio.at("new-action").first.click()
    studio.page.get_by_role("dialog").get_by_role("textbox").fill(action)
    if action == "CheckObstacle":
        studio.page.get_by_role("dialog").get_by_role("radio").nth(1).click()
    studio.at("file-dialog-ok").click()
    editor = studio.page.locator(f'[data-path="actions/{action}.py"] .cm-content')
    editor.click()
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.insert_text(source(action))
    studio.saved()


def fault_is_found_and_mended(studio: Studio) -> None:
    """A mistake in Python is named with its line, and gone after the mending."""
    path = "actions/Turn.py"
    bad = source("Turn").replace("twist.angular.z", "twist.angular.zz")
    line = bad.splitlines().index('        twist.angular.zz = get_input(self, "ang_speed")') + 1
    edit(studio, path, bad)
    studio.at("run").click()
    expect(studio.at("banner")).to_contain_text(f"Turn.py:{line}")
    edit(studio, path, source("Turn"))
    studio.run()
    observer = studio.observe()
    wait_until(lambda: observer.distance_travelled("robot") > 0.3, "the robot drives")
    observer.close()
    studio.at("end-session").click()
    studio.expect_state("idle")


def edit(studio: Studio, path: str, text: str) -> None:
    studio.at(f"file-{path}").click()
    editor = studio.page.locator(f'[data-path="{path}"] .cm-content')
    editor.click()
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.insert_text(text)
    studio.saved()


def package_is_taken_away(studio: Studio) -> None:
    """The dialogue tells what will be in the package; the downloads hold it."""
    studio.at("open-take-away").click()
    expect(studio.at("package-files")).to_contain_text("package.xml")
    expect(studio.at("package-dependencies")).to_contain_text("geometry_msgs")
    expect_accessible(studio, "light")
    studio.picture("take-away")
    studio.at("package-name").fill("my_robot")
    expect(studio.at("take-away-commands")).to_contain_text("ros2 launch my_robot my_robot.launch.py")
    with studio.page.expect_download() as download:
        studio.at("download-package").click()
    names = zipfile.ZipFile(io.BytesIO(Path(download.value.path()).read_bytes())).namelist()
    assert {"my_robot/package.xml", "my_robot/my_robot/actions/Forward.py"} <= set(names)
    for button, start in (
        ("download-project", b"PK"),
        ("download-xml", b"<"),
        ("download-self-contained", b"<"),
        ("download-svg", b"<?xml"),
        ("download-png", b"\x89PNG"),
    ):
        with studio.page.expect_download() as download:
            studio.at(button).click()
        data = Path(download.value.path()).read_bytes()
        assert data.startswith(start), button
        assert len(data) > 500, button
    studio.page.keyboard.press("Escape")
    expect(studio.at("take-away")).to_have_count(0)


def behaviour_is_reused(studio: Studio) -> None:
    """A behaviour of the library comes with what it needs, and a second time under its own name."""
    studio.at("file-trees/MainTree.json").click()
    block(studio, "ReactiveSequence").click()
    studio.page.locator(".flexlayout__tab_button", has_text="Library").click()
    studio.at("behaviour-Docking").get_by_role("button", name="Docking", exact=True).click()
    expect(studio.at("behaviour-Docking")).to_contain_text("actions/ApproachUntilNear.py")
    studio.picture("library")
    studio.at("insert-DriveForward").click()
    expect(studio.at("file-trees/DriveForward.json")).to_be_visible()
    expect(studio.at("file-actions/DriveDistance.py")).to_be_visible()
    expect(studio.at("port-distance")).to_have_value("1.0")
    studio.saved()

    edit(studio, "actions/DriveDistance.py", "# mine\n" + library_source("DriveDistance"))
    studio.at("file-trees/MainTree.json").click()
    studio.at("insert-DriveForward").click()
    expect(studio.at("file-trees/DriveForward2.json")).to_be_visible()
    expect(studio.at("file-actions/DriveDistance2.py")).to_be_visible()
    studio.saved()
    expect_accessible(studio, "light")


def library_source(action: str) -> str:
    folder = Path(__file__).parents[2] / "backend" / "catalog" / "behaviours" / "actions"
    return (folder / f"{action}.py").read_text(encoding="utf-8")


def world_is_chosen(studio: Studio) -> None:
    """Another universe, by its picture; the project keeps it."""
    studio.at("open-worlds").click()
    expect(studio.at("choice-maze").locator("img")).to_be_visible()
    studio.at("choice-maze").click()
    expect_accessible(studio, "light")
    studio.picture("worlds")
    studio.at("choose-world").click()
    expect(studio.at("open-worlds")).to_contain_text("Maze")
    studio.saved()
    studio.page.reload()
    expect(studio.at("open-worlds")).to_contain_text("Maze")
