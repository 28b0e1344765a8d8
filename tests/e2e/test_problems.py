"""Problems by hand: one list for the trees, the Python and the run, and the marks in the Explorer."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.test_code_hands import editor, new, open_editor, replace, tab

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]

TONES = "nodes/tones.py"
BROKEN = "def tone(hertz):\n    return = hertz\n"
GOOD = "def tone(hertz: float) -> float:\n    return hertz\n"
FORWARD = "actions/Forward.py"
RAISES = """import py_trees


class Forward(py_trees.behaviour.Behaviour):
    def update(self) -> py_trees.common.Status:
        raise ValueError("no way ahead")
"""


DEAF = """import py_trees
from std_msgs.msg import String


class CheckObstacle(py_trees.behaviour.Behaviour):
    def setup(self, **kwargs):
        self.ear = kwargs["node"].create_subscription(String, "/scan", print, 10)

    def update(self):
        return py_trees.common.Status.FAILURE
"""
CHECK = "actions/CheckObstacle.py"


def show_problems(studio: Studio) -> Locator:
    studio.page.get_by_role("tab", name="Problems").click()
    expect(studio.at("problems")).to_be_visible()
    return studio.at("problems")


def mark(studio: Studio, path: str) -> Locator:
    """Returns the row of a file in the Explorer, which bears its worst finding."""
    return studio.page.locator(f'[data-severity]:has(> [data-testid="file-{path}"])')


def test_problems_lists_what_is_typed_anywhere_and_what_the_run_raised(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    problems = show_problems(studio)
    expect(problems).to_contain_text("the project can run")

    new(studio, "file", TONES)
    replace(studio, TONES, BROKEN)
    row = problems.get_by_role("button").filter(has_text=f"{TONES}:2").first
    expect(row).to_have_attribute("data-severity", "error")
    expect(problems).not_to_contain_text("can run")
    expect(mark(studio, TONES)).to_have_attribute("data-severity", "error")
    expect(studio.page.get_by_role("contentinfo")).to_contain_text(re.compile(r"\d+ error"))
    studio.page.get_by_role("tab", name=re.compile("MainTree")).click()
    row.click()
    expect(editor(studio, TONES)).to_be_focused()
    expect(studio.page.locator(f'[data-path="{TONES}"] .cm-activeLine')).to_contain_text("return = hertz")
    replace(studio, TONES, GOOD)
    new(studio, "file", "lib/tones.py")
    for folder in ("nodes", "lib"):
        expect(tab(studio, f"tones.py · {folder}")).to_have_count(1)
    expect(problems).to_contain_text("the project can run")
    expect(mark(studio, TONES)).to_have_count(0)

    the_last_declaration_stays(studio)
    replace(studio, FORWARD, RAISES)
    studio.page.keyboard.press("Control+s")
    studio.saved()
    studio.at("run").click()
    fault = problems.get_by_role("button").filter(has_text="no way ahead")
    show_problems(studio)
    expect(fault).to_contain_text(f"{FORWARD}:6")
    expect(fault).to_contain_text("Last run")
    expect(mark(studio, FORWARD)).to_have_attribute("data-severity", "error")
    studio.picture("problems-light")
    expect_accessible(studio, "light")
    open_editor(studio, TONES)
    fault.press("Enter")
    expect(editor(studio, FORWARD)).to_be_focused()
    studio.at("theme-toggle").click()
    studio.picture("problems-dark")


def the_last_declaration_stays(studio: Studio) -> None:
    """The inspector keeps the ports of an action while its Python cannot be read."""
    keys = studio.page.keyboard
    open_editor(studio, FORWARD)
    keys.press("Control+Home")
    keys.type("= ")
    studio.saved()
    tab(studio, "MainTree").click()
    studio.at("node-n6").click()
    expect(studio.at("outdated-ports")).to_contain_text("cannot be read")
    expect(studio.at("port-lin_speed")).to_be_visible()
    studio.picture("outdated-ports-light")
    studio.at("outdated-ports").get_by_role("button", name="Forward.py, line 1").click()
    expect(editor(studio, FORWARD)).to_be_focused()
    keys.press("Delete")
    keys.press("Delete")
    studio.saved()
    tab(studio, "MainTree").click()
    expect(studio.at("outdated-ports")).to_have_count(0)
    expect(studio.at("port-lin_speed")).to_be_visible()


def test_a_new_field_has_the_caret_and_is_blamed_only_when_it_is_left(studio: Studio) -> None:
    page = studio.page
    studio.new_from("laser_bump_and_go")
    page.set_viewport_size({"width": 1440, "height": 640})
    problems = show_problems(studio)
    studio.at("node-n6").click()
    page.get_by_role("button", name="Add condition").click()
    studio.menu("Add condition").get_by_role("menuitem", name="Skip if").click()
    field = page.get_by_role("textbox", name="Skip if")
    expect(field).to_be_focused()
    expect(field).to_be_in_viewport()
    expect(problems).to_contain_text("the project can run")
    expect(field).to_have_class(re.compile("cm-content"))  # a plain field gives way to the editor
    expect(field).to_be_focused()
    page.keyboard.press("Escape")
    expect(field).to_have_count(0)
    page.keyboard.press("Enter")
    studio.menu("Add condition").get_by_role("menuitem", name="Skip if").click()
    expect(field).to_be_focused()
    page.keyboard.press("Tab")
    expect(problems).to_contain_text("_skipIf")
    field.click()
    page.keyboard.type("true")
    expect(problems).not_to_contain_text("is empty")
    expect(problems).to_contain_text("“Forward” is never ticked")
    studio.saved()


@pytest.mark.simulation
def test_a_topic_whose_ends_do_not_match_is_a_problem_until_it_is_repaired(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    replace(studio, CHECK, DEAF)
    studio.saved()
    studio.run()
    problems = show_problems(studio)
    row = problems.get_by_role("button").filter(has_text="Nothing arrives on /scan")
    expect(row).to_have_attribute("data-severity", "error")
    expect(row).to_contain_text("subscribes to std_msgs/msg/String. Use the same message type at both ends.")
    expect(row).to_contain_text(f"{CHECK}:7")
    studio.picture("mismatch")
    tab(studio, "MainTree").click()
    row.press("Enter")
    expect(editor(studio, CHECK)).to_be_focused()
    expect(studio.page.locator(f'[data-path="{CHECK}"] .cm-activeLine')).to_contain_text('"/scan"')
    studio.at("stop").click()
    studio.expect_state("visualization_ready")
    expect(row).to_have_count(0)
    studio.end_session()
