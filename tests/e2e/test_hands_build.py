"""*Bump and go* from an empty project: by keyboard alone, and by mouse alone except for names and code."""

from __future__ import annotations

import io
import struct
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.canvas_by_hand import block, children, focused, rest, the_tree_is_changed_by_hand
from tests.e2e.server import wait_until
from tests.e2e.studio import NOT_RUNNABLE
from translator.importer import from_xml

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.observer import Observer
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

EXAMPLE = Path(__file__).parents[2] / "examples" / "laser_bump_and_go" / "actions"
ACTIONS = ("CheckObstacle", "Turn", "Forward")


def source(action: str) -> str:
    return (EXAMPLE / f"{action}.py").read_text(encoding="utf-8")


def quick(studio: Studio, key: str, name: str) -> None:
    """Opens the quick-add box and chooses the first result."""
    studio.page.keyboard.press(key)
    studio.writing()
    studio.page.keyboard.type(name)
    studio.page.keyboard.press("Enter")
    expect(studio.at("quick-add")).to_have_count(0)
    focused(studio, "canvas")


def write_code(studio: Studio, action: str) -> None:
    """Opens a block's code and returns, by keys."""
    studio.page.keyboard.press("Enter")
    editor = studio.page.locator(f'[data-path="actions/{action}.py"] .cm-content')
    expect(editor).to_be_focused()
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.insert_text(source(action))
    studio.page.keyboard.press("Alt+t")
    focused(studio, "canvas")


def test_by_keyboard_alone(studio: Studio) -> None:
    keys = studio.page.keyboard
    walk_to(studio, studio.at("new-from-empty"))
    keys.press("Enter")
    focused(studio, "canvas")

    quick(studio, "Tab", "ReactiveSequence")
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
    run_is_led_by_keys(studio, observer)
    observer.close()
    package_is_taken_by_keys(studio)
    studio.command("end the session")
    studio.expect_state("idle")


def run_is_led_by_keys(studio: Studio, observer: Observer) -> None:
    """The run is seen on the blocks, paused, stepped, resumed and stopped."""
    keys = studio.page.keyboard
    expect(block(studio, "ReactiveSequence")).to_have_attribute("data-status", "RUNNING")
    keys.press("F6")
    studio.expect_state("paused")
    # No message says that none is on its way: ticks that were made before the pause may still arrive.
    studio.page.wait_for_timeout(500)
    ticks = len(observer.of("tick"))
    keys.press("F10")
    wait_until(lambda: len(observer.of("tick")) == ticks + 1, "one tick is made")
    keys.press("F7")
    studio.expect_state("application_running")
    keys.press("Shift+F5")
    studio.expect_state("visualization_ready")
    # Statuses on the blocks are not undo steps.
    keys.press("Control+z")
    expect(block(studio, "Forward")).not_to_contain_text("go on")
    keys.press("Control+y")
    expect(block(studio, "Forward")).to_contain_text("go on")


def package_is_taken_by_keys(studio: Studio) -> None:
    page, keys = studio.page, studio.page.keyboard
    keys.press("Control+Shift+KeyS")
    expect(studio.at("package-files")).to_be_visible()
    walk_to(studio, studio.at("download-package"))
    with page.expect_download() as download:
        keys.press("Enter")
    assert zipfile.is_zipfile(download.value.path())
    keys.press("Escape")
    expect(studio.at("take-away")).to_have_count(0)


def walk_to(studio: Studio, target: Locator) -> None:
    """Presses Tab until the element has the focus."""
    for _ in range(40):
        if target.evaluate("element => element === document.activeElement"):
            return
        studio.page.keyboard.press("Tab")
    pytest.fail("Tab does not lead there")


def ports_names_and_order_by_keys(studio: Studio) -> None:
    """Changes a port, a name and a position, and reverts them, without leaving the keyboard."""
    keys = studio.page.keyboard
    keys.press("F4")
    focused(studio, "port-lin_speed")
    keys.type("0.4")
    keys.press("Escape")
    focused(studio, "canvas")
    keys.press("F2")
    studio.writing()
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
    """Each dialogue opens with the focus on its main field; Escape returns the focus to the tree."""
    page, keys = studio.page, studio.page.keyboard
    dialogue = page.get_by_role("dialog")
    wanted = {
        "new action": dialogue.get_by_role("textbox"),
        "new world": page.get_by_test_id("new-universe-name"),
        "settings of the project": dialogue.get_by_role("textbox", name="Name"),
        "world and robot": dialogue.get_by_role("radio", checked=True).first,
        "keyboard shortcuts": dialogue.get_by_role("button", name="Close"),
    }
    for name, first in wanted.items():
        studio.command(name)
        expect(first).to_be_focused()
        keys.press("Escape")
        expect(dialogue).to_have_count(0)
        focused(studio, "canvas")


@pytest.mark.long_walk
def test_by_mouse(studio: Studio) -> None:
    studio.at("new-from-empty").click()
    expect(studio.at("ghost-block")).to_be_visible()
    for action in ACTIONS:
        new_action(studio, action)
    studio.at("file-trees/MainTree.json").click()
    expect(studio.at("canvas")).to_be_visible()

    studio.at("palette-Sequence").drag_to(studio.at("ghost-block"))
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
        rest(block(studio, onto))  # it may be tidied still
        studio.at(f"palette-{block_type}").drag_to(block(studio, onto))
        expect(block(studio, block_type)).to_be_visible()
        studio.at("tidy").click()
    assert children(studio)[:3] == ["ReactiveSequence", "ReactiveFallback", "Forward"]
    studio.at("undo").click()
    studio.at("redo").click()
    studio.saved()
    expect_accessible(studio, "light")
    studio.picture("built-light")
    the_tree_is_changed_by_hand(studio)


@pytest.mark.long_walk
def test_what_was_built_is_repaired_exported_and_reused(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    fault_is_found_and_fixed(studio)
    package_is_exported(studio)
    behaviour_is_reused(studio)
    world_is_chosen(studio)


def new_action(studio: Studio, action: str) -> None:
    """Creates an action from the explorer, and types its code."""
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


def fault_is_found_and_fixed(studio: Studio) -> None:
    """An error in Python is reported with its line, and disappears after the fix."""
    path = "actions/Turn.py"
    bad = source("Turn").replace("twist.angular.z", "twist.angular.zz")
    line = bad.splitlines().index('        twist.angular.zz = get_input(self, "ang_speed")') + 1
    edit(studio, path, bad)
    studio.may_be_refused(NOT_RUNNABLE)
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


def package_is_exported(studio: Studio) -> None:
    """The dialogue lists the content of the package; the downloads have it."""
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
        assert is_whole(button, data), button
    studio.page.keyboard.press("Escape")
    expect(studio.at("take-away")).to_have_count(0)


def is_whole(button: str, data: bytes) -> bool:
    """Returns whether a download is readable, and has the expected content."""
    if button == "download-project":
        archive = zipfile.ZipFile(io.BytesIO(data))
        return archive.testzip() is None and {"project.json", "actions/Turn.py"} <= set(archive.namelist())
    if button == "download-png":
        width, height = struct.unpack(">II", data[16:24])
        return min(width, height) > 200 and data[-8:-4] == b"IEND"
    text = data.decode()
    if button == "download-svg":
        return all(f">{action}</text>" in text for action in ACTIONS) and text.endswith("</svg>\n")
    types = {node.type for tree in from_xml(text).trees.values() for node in tree.nodes.values()}
    return set(ACTIONS) <= types and ("class Turn" in text) == (button == "download-self-contained")


def behaviour_is_reused(studio: Studio) -> None:
    """A behaviour of the library is added with its files, and a second time under another name."""
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
    expect(studio.at("arrival-actions/DriveDistance.py")).to_contain_text(
        "the incoming one is named DriveDistance2"
    )
    studio.at("take-arrivals").click()
    expect(studio.at("file-trees/DriveForward2.json")).to_be_visible()
    expect(studio.at("file-actions/DriveDistance2.py")).to_be_visible()
    studio.saved()
    expect_accessible(studio, "light")


def library_source(action: str) -> str:
    folder = Path(__file__).parents[2] / "backend" / "catalog" / "behaviours" / "actions"
    return (folder / f"{action}.py").read_text(encoding="utf-8")


def world_is_chosen(studio: Studio) -> None:
    """Another universe is chosen by its picture; the project stores it."""
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
