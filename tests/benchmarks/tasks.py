"""Ten tasks of a new user, done with mouse and keys in Chromium: `python -m tests.benchmarks.tasks`.

Each click, drag, shortcut and filled field is a step. The task is only done when the page shows what the user
wanted; the table stands in `docs/explanation/ten-tasks.md`.
"""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from playwright.sync_api import expect, sync_playwright

from tests.e2e.conftest import CHROMIUM, QUIET, SOFTWARE_WEBGL
from tests.e2e.server import serving, wait_until
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Locator

BUMP_AND_GO = "laser_bump_and_go"
FOLLOW_PERSON = "visual_follow_person"


class Hand:
    """A user's hand: it acts, and counts its steps."""

    def __init__(self, studio: Studio) -> None:
        self.studio = studio
        self.steps = 0

    def click(self, target: Locator | str) -> None:
        """Clicks an element, given as such or by its test id."""
        self.steps += 1
        (self.studio.at(target) if isinstance(target, str) else target).click()

    def fill(self, target: str, text: str) -> None:
        """Types into a field."""
        self.steps += 1
        self.studio.at(target).fill(text)

    def press(self, keys: str) -> None:
        """Presses a key or a shortcut."""
        self.steps += 1
        self.studio.page.keyboard.press(keys)

    def type(self, text: str) -> None:
        """Types where the cursor is."""
        self.steps += 1
        self.studio.page.keyboard.insert_text(text)

    def run(self) -> None:
        """Presses Run; waiting is not a step."""
        self.steps += 1
        self.studio.run()


def turn_the_other_way(hand: Hand) -> None:
    hand.click("node-n5")
    hand.fill("port-ang_speed", "-0.6")
    hand.run()
    expect(hand.studio.at("node-n5")).to_contain_text("-0.6")


def say_something_else(hand: Hand) -> None:
    studio = hand.studio
    hand.click("file-actions/Forward.py")
    hand.click(studio.page.locator(".cm-line", has_text="The way is free").first)
    hand.press("End")
    hand.type("; print('whee')")
    hand.run()
    expect(studio.at("console")).to_contain_text("whee")


def find_the_faulty_line(hand: Hand) -> None:
    studio = hand.studio
    studio.open_file("actions/Turn.py")
    code = studio.at("code-editor").locator(".cm-content")
    code.click()
    studio.page.keyboard.press("Control+Home")
    studio.page.keyboard.insert_text("nothing = 1 / 0\n")
    studio.saved()
    hand.click("run")
    hand.click(studio.at("banner").get_by_role("button").first)
    expect(studio.page.locator(".cm-activeLine")).to_contain_text("nothing = 1")


def see_what_it_did(hand: Hand) -> None:
    studio = hand.studio
    studio.run()
    hand.click(studio.page.get_by_role("tab", name="Timeline", exact=True))
    hand.click(studio.at("timeline").get_by_role("button", name=re.compile("^Forward,")))
    expect(studio.at("node-statistics").locator("[data-key=runs] dd")).not_to_have_text("0")


def stop_and_change_what_it_believes(hand: Hand) -> None:
    studio = hand.studio
    studio.run()
    hand.click(studio.page.get_by_role("tab", name="Blackboard", exact=True))
    row = studio.at("blackboard-person_height")
    expect(row).to_be_visible()
    hand.click("pause")
    studio.expect_state("paused")
    hand.click(row.get_by_role("textbox"))
    hand.press("Control+a")
    hand.type("123")
    hand.press("Enter")
    expect(row.get_by_role("textbox")).to_have_value(re.compile("^123"))


def try_three_times(hand: Hand) -> None:
    studio = hand.studio
    hand.click("node-n6")
    hand.press("Control+g")
    hand.type("RetryUntilSuccessful")
    hand.press("Enter")
    hand.fill("port-num_attempts", "3")
    expect(studio.at("canvas").locator("[data-type=RetryUntilSuccessful]")).to_contain_text("3")


def go_elsewhere(hand: Hand) -> None:
    hand.click("open-worlds")
    hand.click("choice-maze")
    hand.click("choose-world")
    expect(hand.studio.at("open-worlds")).to_contain_text("Maze")
    hand.run()


def use_what_others_made(hand: Hand) -> None:
    studio = hand.studio
    hand.click("node-n1")
    hand.click(studio.page.locator(".flexlayout__tab_button", has_text="Library"))
    hand.click("insert-DriveForward")
    expect(studio.at("file-trees/DriveForward.json")).to_be_visible()
    expect(studio.at("file-actions/DriveDistance.py")).to_be_visible()


def reuse_in_another_project(hand: Hand) -> None:
    studio = hand.studio
    hand.click("node-n2")
    hand.press("Control+c")
    hand.click(studio.page.get_by_role("link", name=re.compile("project", re.IGNORECASE)).first)
    hand.click("new-from-empty")
    expect(studio.at("canvas")).to_be_focused()
    hand.press("Control+v")
    expect(studio.at("canvas").locator("[data-type=CheckObstacle]")).to_be_visible()


def take_it_to_a_robot(hand: Hand) -> None:
    studio = hand.studio
    hand.click("open-take-away")
    with studio.page.expect_download() as download:
        hand.click("download-package")
    assert Path(download.value.path()).read_bytes().startswith(b"PK")


TASKS: tuple[tuple[str, str, Callable[[Hand], None]], ...] = (
    ("make the robot turn the other way", BUMP_AND_GO, turn_the_other_way),
    ("change a line of an action and see its effect", BUMP_AND_GO, say_something_else),
    ("find the line that made a run fail", BUMP_AND_GO, find_the_faulty_line),
    ("see how often a node ran, and for how long", BUMP_AND_GO, see_what_it_did),
    ("stop it and change a value of the blackboard", FOLLOW_PERSON, stop_and_change_what_it_believes),
    ("have a node tried three times", BUMP_AND_GO, try_three_times),
    ("run it in another world", BUMP_AND_GO, go_elsewhere),
    ("use a behaviour that somebody has made", BUMP_AND_GO, use_what_others_made),
    ("take a part of the tree to another project", BUMP_AND_GO, reuse_in_another_project),
    ("download it as a ROS 2 package", BUMP_AND_GO, take_it_to_a_robot),
)


def main() -> None:
    """Does each task in a new project, on one server, and prints its steps."""
    expect.set_options(timeout=60_000)
    with sync_playwright() as playwright, tempfile.TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=[*QUIET, *SOFTWARE_WEBGL])
        with serving(Path(folder)) as server:
            for name, template, task in TASKS:
                context = browser.new_context(viewport={"width": 1440, "height": 900})
                studio = Studio(context.new_page(), server)
                studio.page.set_default_timeout(120_000)
                studio.open()
                studio.new_from(template)
                hand = Hand(studio)
                task(hand)
                if studio.at("executor-state").get_attribute("data-state") != "idle":
                    studio.at("end-session").click()
                    wait_until(lambda: not server.children(), "the session ends")
                assert studio.complaints == [], studio.complaints
                print(f"{hand.steps:3}  {name}", flush=True)
                context.close()
        browser.close()


if __name__ == "__main__":
    main()
