"""A lesson of a quarter of an hour, as a pupil of 15 years lives it, with all her hesitations.

Ana knows Scratch and has never seen a behaviour tree. Her sheet says: let the robot drive; make it slow; let
it turn to the other side; let it wait before it turns; let it say "beep" by an action of your own; bring the
file to the teacher. Each `#` says what she thinks or does wrong; what follows is what the page must do.
`docs/explanation/a-first-lesson.md` tells what was found.
"""

from __future__ import annotations

import zipfile
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, children, drag, middle, place, rest
from tests.e2e.server import wait_until
from tests.e2e.studio import NOT_RUNNABLE
from tests.e2e.test_lesson import LESSONS_OPEN

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

TREE = ["ReactiveSequence", "ReactiveFallback", "Forward", "Inverter", "Turn", "CheckObstacle"]
# As she types it: the loop of Scratch in mind, and one line too far to the left.
BEEP = '''\
import py_trees


class Beep(py_trees.behaviour.Behaviour):
    """Says beep."""

    def update(self):
    print("beep")
        return py_trees.common.Status.SUCCESS
'''


@pytest.mark.long_walk
def test_a_pupil_has_her_first_lesson(studio: Studio) -> None:
    studio.page.add_init_script(LESSONS_OPEN)
    studio.open()
    minute_0_the_robot_drives(studio)
    minute_3_it_is_made_slow(studio)
    minute_5_it_turns_to_the_other_side(studio)
    minute_6_it_waits_before_it_turns(studio)
    minute_9_it_says_beep(studio)
    minute_12_things_get_lost(studio)
    minute_14_the_file_goes_to_the_teacher(studio)


def tree(studio: Studio) -> Locator:
    return studio.at("canvas")


def minute_0_the_robot_drives(studio: Studio) -> None:
    page, keys = studio.page, studio.page.keyboard
    # "Which of these?" She looks for a play button, and clicks the picture of the room, not the name.
    card = studio.at("new-from-laser_bump_and_go")
    card.locator("img").click()
    expect(studio.at("lesson").get_by_role("heading", name="Bump and go")).to_be_visible()
    # "In games it is Space." Nothing is selected, and nothing must happen.
    expect(block(studio, "Turn")).to_be_visible()
    tree(studio).focus()
    keys.press("Space")
    wait_until(lambda: sorted(children(studio)) == sorted(TREE), "the tree is as before")
    # She grabs the empty canvas, and the tree is gone. "Did I delete it?"
    rest(block(studio, "Turn"))
    x, y, width, height = place(tree(studio))
    page.mouse.move(x + 8, y + height - 80)
    page.mouse.down()
    page.mouse.move(x + width - 8, y + 10, steps=8)
    page.mouse.up()
    expect(studio.at("undo")).to_be_disabled()
    keys.press("Control+z")
    studio.picture("pupil-lost")
    studio.at("back-to-tree").click()
    expect(studio.at("back-to-tree")).to_have_count(0)
    expect(block(studio, "ReactiveSequence")).to_be_in_viewport()
    # The lesson's own button is the first thing that looks like play.
    studio.at("lesson").get_by_role("button", name="Run it").click()
    studio.expect_state("application_running")
    wait_until(lambda: studio.stat("distance") > 0.2, "the robot drives")
    # She wants to take the robot with the mouse: the view turns instead, and does not follow any more.
    view = studio.at("viewer-3d").locator("canvas").first
    x, y = middle(view)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y + 20, steps=4)
    page.mouse.up()
    studio.at("viewer-3d").get_by_role("button", name="Follow", exact=True).click()
    expect(studio.at("viewer-3d").get_by_role("button", name="Follow", exact=True)).to_have_count(0)


def minute_3_it_is_made_slow(studio: Studio) -> None:
    keys = studio.page.keyboard
    # "Where is the speed?" A double click, as on a file, opens Python. "Not that." She closes it.
    forward = block(studio, "Forward")
    forward.dblclick()
    code = studio.page.get_by_role("tab", name="Forward.py", exact=True)
    expect(code).to_have_attribute("aria-selected", "true")
    code.locator(".flexlayout__tab_button_trailing").click()
    expect(code).to_have_count(0)
    forward.click()
    speed = studio.at("port-lin_speed")
    speed.click()
    # A comma, as at school, over the old number. The block is marked, and the fix writes the point.
    keys.type("0,15")
    expect(speed).to_have_value("0,15")
    expect(forward).to_have_attribute("data-problem", "warning")
    studio.at("inspector").get_by_role("button", name="Write 0.15").click()
    expect(speed).to_have_value("0.15")
    expect(forward).not_to_have_attribute("data-problem", "error")
    # "Why is it still fast?" She presses the big button again.
    studio.run()
    wait_until(lambda: 0.05 < studio.stat("speed") < 0.2, "the robot is slow")


def minute_5_it_turns_to_the_other_side(studio: Studio) -> None:
    # She deletes the block by mistake, since Backspace is what she presses to delete the number.
    turn = block(studio, "Turn")
    turn.click()
    studio.page.keyboard.press("Backspace")
    expect(turn).to_have_count(0)
    studio.at("undo").click()
    turn.click()
    studio.at("port-ang_speed").fill("-0.6")
    expect(turn).to_contain_text("-0.6")
    studio.saved()


def minute_6_it_waits_before_it_turns(studio: Studio) -> None:
    page, keys = studio.page, studio.page.keyboard
    # "Wait" is what it is called in Scratch.
    page.get_by_role("tab", name="Nodes", exact=True).click()
    search = studio.at("palette").get_by_role("textbox").first
    search.fill("wait")
    sleep = studio.at("palette-Sleep")
    expect(sleep).to_be_visible()
    # She drops it onto Turn, which cannot have a child: it goes beside it, into the fallback.
    rest(block(studio, "Turn"))
    sleep.drag_to(block(studio, "Turn"))
    added = block(studio, "Sleep")
    expect(added).to_be_visible()
    expect(added).to_have_attribute("data-problem", "error")
    # "How long?" The red block asks; she types a unit.
    added.click()
    field = studio.at("port-msec")
    field.click()
    keys.type("1 s")
    expect(added).to_have_attribute("data-problem", "error")
    field.fill("1000")
    expect(added).not_to_have_attribute("data-problem", "error")
    # A wait that succeeds ends the fallback: the robot never turns. She takes both into a sequence.
    rest(added)
    row = [type_ for type_ in children(studio) if type_ in ("Turn", "Sleep")]
    if row == ["Turn", "Sleep"]:
        x, y = middle(block(studio, "Turn"))
        drag(studio, added, x - 90, y)
    wait_until(
        lambda: [type_ for type_ in children(studio) if type_ in ("Turn", "Sleep")] == ["Sleep", "Turn"],
        "the wait is before the turn",
    )
    added.click()
    block(studio, "Turn").click(modifiers=["Control"])
    block(studio, "Turn").click(button="right")
    studio.at("menu-wrapSequence").click()
    expect(block(studio, "Sequence")).to_be_visible()
    search.fill("")
    studio.saved()


def minute_9_it_says_beep(studio: Studio) -> None:
    page, keys = studio.page, studio.page.keyboard
    # "An action of my own." The name has a sign that Python does not take.
    studio.at("palette").get_by_test_id("new-action").click()
    name = studio.at("palette").get_by_role("textbox").last
    name.fill("beep!")
    name.press("Enter")
    expect(studio.at("palette")).to_contain_text("Letters, digits and _ only")
    name.fill("Beep")
    name.press("Enter")
    studio.page.get_by_role("tab", name="Explorer", exact=True).click()
    studio.open_file("actions/Beep.py")
    studio.replace_code(BEEP)
    # She puts it before the wait, though a line of it is red, and runs.
    page.get_by_role("tab", name="MainTree", exact=True).click()
    page.get_by_role("tab", name="Nodes", exact=True).click()
    rest(block(studio, "Sleep"))
    # Its left side means before it.
    x, y, width, height = place(block(studio, "Sleep"))
    drag(studio, studio.at("palette-Beep"), x + width / 8, y + height / 2)
    expect(block(studio, "Beep")).to_be_visible()
    wait_until(lambda: children(studio)[-3:] == ["Beep", "Sleep", "Turn"], "it is before the wait")
    studio.may_be_refused(NOT_RUNNABLE)
    studio.at("run").click()
    problem = studio.at("problems").get_by_role("button").filter(has_text="Beep.py").first
    expect(problem).to_contain_text("Beep.py:8")
    problem.click()
    studio.picture("pupil-problem")
    # The caret stands on the line: four more blanks.
    expect(studio.at("code-editor").locator(".cm-activeLine")).to_contain_text('print("beep")')
    keys.press("Home")
    keys.type("    ")
    studio.saved()
    studio.run()
    page.get_by_role("tab", name="Console", exact=True).click()
    page.get_by_role("tab", name="MainTree", exact=True).click()
    studio.picture("pupil-run-3")
    # She waits for the wall, then sees it.
    expect(studio.at("console").get_by_role("log")).to_contain_text("beep")
    studio.picture("pupil-beep")


def minute_12_things_get_lost(studio: Studio) -> None:
    page, keys = studio.page, studio.page.keyboard
    # She closes the tab of the tree. "Everything is gone!"
    page.get_by_role("tab", name="MainTree", exact=True).locator(".flexlayout__tab_button_trailing").click()
    expect(block(studio, "ReactiveSequence")).to_have_count(0)
    page.get_by_role("tab", name="Explorer", exact=True).click()
    studio.at("file-trees/MainTree.json").click()
    expect(block(studio, "ReactiveSequence")).to_be_visible()
    # She selects the top, presses Delete, and stares at an empty canvas.
    block(studio, "ReactiveSequence").click()
    keys.press("Delete")
    expect(block(studio, "Forward")).to_have_count(0)
    keys.press("Control+z")
    expect(block(studio, "Beep")).to_be_visible()
    # F5 is what loads a page again; here it runs. Then the browser's button does it: all is there.
    keys.press("F5")
    studio.expect_state("application_running")
    studio.saved()
    page.reload()
    expect(block(studio, "Beep")).to_be_visible()
    studio.expect_state("application_running")


def minute_14_the_file_goes_to_the_teacher(studio: Studio) -> None:
    page = studio.page
    studio.at("stop").click()
    studio.expect_state("visualization_ready")
    # "Save as" is what she looks for: Ctrl+S saves here, and says so; the file comes by *Download…*.
    page.keyboard.press("Control+s")
    studio.saved()
    page.get_by_role("button", name="More", exact=True).click()
    page.get_by_role("menuitem", name="Download…").click()
    with page.expect_download() as download:
        studio.at("download-project").click()
    names = zipfile.ZipFile(download.value.path()).namelist()
    assert {"actions/Beep.py", "trees/MainTree.json"} <= set(names)
    page.keyboard.press("Escape")
    page.get_by_role("link", name="All projects").click()
    expect(studio.at("project-card")).to_have_count(1)
    expect(studio.at("project-card").locator("a svg")).to_be_visible()
    studio.picture("pupil-end")
