"""Ports that are changed by hand while the program runs."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.test_code_hands import replace, tab

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

FORWARD = """import py_trees

from tree_gardener.ports import Port, get_input


class Forward(py_trees.behaviour.Behaviour):
    INPUT_PORTS = {"lin_speed": Port(float, default=0.3), "once": Port(str, default="first")}
    seen = None

    def setup(self, **kwargs):
        print("at the start", get_input(self, "once"))

    def update(self):
        if self.seen != get_input(self, "lin_speed"):
            self.seen = get_input(self, "lin_speed")
            print("speed", self.seen)
        return py_trees.common.Status.RUNNING
"""


def test_ports_are_changed_while_the_program_runs(studio_without_views: Studio) -> None:
    studio = studio_without_views
    studio.new_from("laser_bump_and_go")
    an_action_tells_its_port(studio)
    the_program_takes_what_is_typed_with_enter(studio)
    undo_reaches_the_program(studio)
    a_value_is_kept_or_goes_back(studio)
    a_wrong_value_is_not_taken(studio)
    a_value_that_is_read_once_waits_for_the_next_start(studio)
    studio.end_session()


def field(studio: Studio, port: str = "lin_speed") -> Locator:
    return studio.at(f"port-{port}")


def live(studio: Studio, port: str = "lin_speed") -> Locator:
    return studio.at(f"live-{port}")


def marks(studio: Studio) -> Locator:
    return studio.at("node-n6").locator("[data-live]")


def told(studio: Studio, text: str) -> None:
    expect(studio.at("console").get_by_text(text, exact=True).last).to_be_visible()


def an_action_tells_its_port(studio: Studio) -> None:
    replace(studio, "actions/Forward.py", FORWARD)
    studio.saved()
    tab(studio, "MainTree").click()
    studio.at("node-n6").click()
    expect(field(studio, "once")).to_be_visible()
    studio.run()
    told(studio, "speed 0.3")
    expect(marks(studio)).to_have_count(0)


def the_program_takes_what_is_typed_with_enter(studio: Studio) -> None:
    """Half a number is another number: the program does not see it."""
    field(studio).click()
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.type("0.75")
    expect(studio.page.get_by_text("Press Enter to send this value to the running program.")).to_be_visible()
    studio.saved()
    studio.page.keyboard.press("Enter")
    told(studio, "speed 0.75")
    expect(studio.at("console").get_by_text("speed 0.7", exact=True)).to_have_count(0)
    expect(live(studio)).to_contain_text("Changed since the program was started. Before: 0.3")
    expect(marks(studio)).to_have_attribute(
        "title", "0.75 – changed since the program was started; before: 0.3"
    )
    expect(studio.at("banner")).to_have_count(0)
    studio.picture("live-port")


def undo_reaches_the_program(studio: Studio) -> None:
    studio.at("canvas").focus()
    studio.page.keyboard.press("Control+z")
    expect(field(studio)).to_have_value("0.3")
    expect(marks(studio)).to_have_count(0)
    studio.page.keyboard.press("Control+Shift+z")
    expect(marks(studio)).to_have_count(1)


def a_value_is_kept_or_goes_back(studio: Studio) -> None:
    # A press ends the wait of the canvas for the focus after the redo.
    field(studio).click()
    live(studio).get_by_role("button", name="Keep this value").press("Enter")
    expect(marks(studio)).to_have_count(0)
    expect(field(studio)).to_be_focused()
    studio.page.keyboard.press("ArrowUp")
    told(studio, "speed 0.76")
    expect(live(studio)).to_contain_text("Before: 0.75")
    live(studio).get_by_role("button", name="Back to the value before").click()
    expect(field(studio)).to_have_value("0.75")
    expect(live(studio)).to_have_count(0)


def a_wrong_value_is_not_taken(studio: Studio) -> None:
    field(studio).fill("fast")
    field(studio).press("Enter")
    expect(live(studio)).to_contain_text("'fast' is not a number")
    expect(marks(studio)).to_have_attribute("data-live", "refused")
    live(studio).get_by_role("button", name="Back to the value before").click()
    expect(field(studio)).to_have_value("0.75")


def a_value_that_is_read_once_waits_for_the_next_start(studio: Studio) -> None:
    field(studio, "once").fill("second")
    field(studio, "once").press("Enter")
    expect(live(studio, "once")).to_contain_text("reads the port only once")
    expect(marks(studio)).to_have_attribute("data-live", "next_start")
    studio.saved()
    studio.at("restart").click()
    told(studio, "at the start second")
    expect(marks(studio)).to_have_count(0)
