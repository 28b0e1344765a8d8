"""Writing Python: completion, formatting, renaming; and two tabs on one project."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Locator

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

SOURCE = """import os
import py_trees
from geometry_msgs.msg import Twist

from Turn import Turn


class Forward(py_trees.behaviour.Behaviour):
    def update(self):
        twist = Twist()
        twist.linear.x = 0.5
        return   py_trees.common.Status.RUNNING
"""


def editor(studio: Studio) -> Locator:
    return studio.at("code-editor").locator(".cm-content")


def line(studio: Studio, text: str) -> Locator:
    return studio.page.locator('[data-testid="code-editor"]:visible .cm-line', has_text=text).first


def spot(studio: Studio, text: str, word: str) -> tuple[float, float]:
    """Returns the middle of the last `word` in the line that contains `text`."""
    box = line(studio, text).evaluate(
        """(element, word) => {
            const walker = document.createTreeWalker(element, NodeFilter.SHOW_TEXT);
            let box = null;
            for (let node = walker.nextNode(); node; node = walker.nextNode()) {
                const at = node.data.lastIndexOf(word);
                if (at < 0) continue;
                const range = document.createRange();
                range.setStart(node, at);
                range.setEnd(node, at + word.length);
                box = range.getBoundingClientRect();
            }
            return [box.x + box.width / 2, box.y + box.height / 2];
        }""",
        word,
    )
    return box[0], box[1]


def expect_help(studio: Studio) -> None:
    expect(studio.at("language-state")).to_have_attribute("data-state", "ready")


def network_of(studio: Studio) -> Callable[[bool], None]:
    """Disconnects one tab (True), or connects it again; the other tab stays connected."""
    session = studio.page.context.new_cdp_session(studio.page)
    session.send("Network.enable")
    speed = {"latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}

    def cut_off(cut: bool) -> None:
        session.send("Network.emulateNetworkConditions", {"offline": cut, **speed})

    return cut_off


def begin(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.open_file("actions/Forward.py")
    expect_help(studio)
    studio.replace_code(SOURCE)


def test_completion_findings_and_types(studio: Studio) -> None:
    begin(studio)
    page = studio.page

    # Completion knows the fields of messages.
    line(studio, "twist.linear.x").click()
    page.keyboard.press("End")
    page.keyboard.type("\ntwist.angular.")
    options = page.locator(".cm-tooltip-autocomplete li")
    expect(options.first).to_contain_text("x")
    studio.picture("code-completion-light")
    options.first.click()
    page.keyboard.type(" = 0.1")
    expect(line(studio, "twist.angular.x = 0.1")).to_be_visible()

    # A wrong name is marked, with a fix; the pointer shows types.
    page.keyboard.type("\ntwist.liner")
    wrong = page.locator(".cm-lintRange-error", has_text="liner")
    expect(wrong).to_be_visible()
    page.keyboard.press("Control+z")
    expect(wrong).to_have_count(0)
    page.mouse.move(*spot(studio, "import Twist", "Twist"))
    expect(page.locator(".cm-tooltip-hover")).to_contain_text("geometry_msgs/msg/Twist")
    studio.picture("code-hover-light")

    # The docstring of a class is read as its author meant it, in a small card that Escape closes.
    page.mouse.move(*spot(studio, "py_trees.behaviour.Behaviour", "Behaviour"))
    card = page.locator(".cm-tooltip-hover")
    expect(card.get_by_role("heading", name="Arguments")).to_be_visible()
    expect(card).to_contain_text("Composite instance if nested in a tree")
    expect(card).not_to_contain_text(":class:")
    box = card.bounding_box()
    assert box is not None
    assert box["width"] <= 480
    assert box["height"] <= 260
    studio.picture("code-hover-class-light")
    page.keyboard.press("Escape")
    expect(card).to_have_count(0)


def test_fixes_formatting_definition_and_renaming(studio: Studio) -> None:
    begin(studio)
    page = studio.page

    # A finding offers to remove an unused import; undo restores it. The module's text, which comes later,
    # moves the button.
    page.mouse.move(*spot(studio, "import os", "os"))
    expect(page.locator(".cm-lsp-hover-tooltip")).to_be_visible()
    page.get_by_role("button", name="Remove unused import: `os`").click()
    expect(line(studio, "import os")).to_have_count(0)
    page.keyboard.press("Control+z")
    expect(line(studio, "import os")).to_be_visible()

    # Saving formats, undo reverts the formatting, a broken file is saved unchanged.
    expect(line(studio, "return   py_trees")).to_be_visible()
    page.keyboard.press("Control+s")
    expect(line(studio, "return py_trees")).to_be_visible()
    page.keyboard.press("Control+z")
    expect(line(studio, "return   py_trees")).to_be_visible()
    page.keyboard.press("Control+End")
    page.keyboard.type("\ndef broken(:")
    page.keyboard.press("Control+s")
    studio.saved()
    expect(line(studio, "def broken(:")).to_be_visible()
    expect(line(studio, "return   py_trees")).to_be_visible()
    studio.replace_code(SOURCE)

    # F12 opens another file of the project; F2 renames the action there: its file and its blocks, too.
    page.mouse.click(*spot(studio, "from Turn import Turn", "Turn"))
    page.keyboard.press("F12")
    expect(page.locator('[data-testid="code-editor"][data-path="actions/Turn.py"]')).to_be_visible()
    page.mouse.click(*spot(studio, "class Turn", "Turn"))
    page.keyboard.press("F2")
    dialogue = page.get_by_role("dialog", name="Rename Turn")
    expect(dialogue).to_contain_text("2 places in 2 files")
    dialogue.get_by_role("textbox").fill("Rotate")
    expect(dialogue.get_by_role("region")).to_contain_text("class TurnRotate(")
    expect_no_findings(page, "the dialogue of a rename")
    studio.picture("code-rename-light")
    page.keyboard.press("Enter")
    expect(dialogue).to_have_count(0)
    expect(studio.at("file-actions/Rotate.py")).to_be_visible()
    expect(studio.at("file-actions/Turn.py")).to_have_count(0)
    studio.saved()


def test_two_tabs_see_each_others_saves_and_conflicts_are_merged(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.open_file("actions/Forward.py")
    other = Studio(studio.page.context.new_page(), studio.server)
    other.page.goto(studio.page.url)
    expect(other.at("code-editor")).to_be_visible()

    studio.replace_code("# said in the first tab\n")
    expect(line(other, "# said in the first tab")).to_be_visible()
    other.picture("code-two-tabs-light")

    # Both write at the same time: the later one is asked, and nothing of either is lost.
    cut_off = network_of(other)
    cut_off(True)
    editor(other).click()
    other.page.keyboard.press("Control+End")
    other.page.keyboard.type("# from the second")
    expect(other.at("save-state")).to_have_attribute("data-state", "failed")
    studio.replace_code("# said in the first tab\n# and more\n")
    cut_off(False)
    merge = other.page.get_by_role("dialog")
    expect(merge).to_contain_text("Two versions of actions/Forward.py")
    other.picture("code-conflict-light")
    other.at("keep-mine").click()
    other.saved()
    expect(line(studio, "# from the second")).to_be_visible()
    assert other.complaints == []
