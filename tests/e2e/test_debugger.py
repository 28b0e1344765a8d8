"""The debugger in the page: find out why *Turn* never ends, correct it, run again; by mouse and by keys."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

ROOT, INVERTER, CHECK, TURN = "n1", "n3", "n4", "n5"


def test_why_turn_never_ends_is_found_with_a_breakpoint(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.set_port(CHECK, "obs_dist", "50")  # any wall is an obstacle, so that Turn never ends
    studio.run()
    expect(studio.at(f"node-{TURN}")).to_have_attribute("data-status", "RUNNING")
    it_is_held_by_the_mouse(studio)
    its_result_is_seen_by_keys(studio)
    a_result_is_forced_and_released(studio)
    breakpoints_outlast_a_reload(studio)
    the_past_of_a_held_run_is_looked_at(studio)
    the_line_is_found(studio)
    it_is_corrected_and_run_again(studio)
    all_breakpoints_are_switched_off_by_a_key(studio)
    studio.end_session()


def held_at(studio: Studio, node: str, words: str) -> None:
    expect(studio.at(f"node-{node}")).to_have_attribute("data-held", "here")
    expect(studio.at("held-banner")).to_contain_text(words)
    studio.expect_state("held")


def it_is_held_by_the_mouse(studio: Studio) -> None:
    studio.at(f"node-{CHECK}").click()
    studio.at(f"breakpoint-{CHECK}").click()
    held_at(studio, CHECK, "before its tick")
    expect(studio.at(f"node-{ROOT}")).to_have_attribute("data-held", "path")
    expect(studio.at("stop-obs_dist")).to_contain_text("50")
    expect(studio.at("held-banner").get_by_test_id("tick-back")).to_be_disabled()  # it is a live run
    studio.picture("held")
    studio.at("debug-over").click()
    held_at(studio, CHECK, "it returned SUCCESS")  # an obstacle, at any distance


def its_result_is_seen_by_keys(studio: Studio) -> None:
    keyboard = studio.page.keyboard
    keyboard.press("F11")
    held_at(studio, INVERTER, "it returned")
    keyboard.press("F5")
    held_at(studio, CHECK, "before its tick")


def a_result_is_forced_and_released(studio: Studio) -> None:
    studio.at(f"node-{CHECK}").click(button="right")
    studio.at("menu-forceFailure").click()
    expect(studio.at(f"forced-MainTree/{CHECK}")).to_contain_text("FAILURE")
    studio.page.keyboard.press("F10")
    held_at(studio, CHECK, "it returned FAILURE")
    studio.at("release").click()
    expect(studio.at(f"forced-MainTree/{CHECK}")).to_have_count(0)


def the_past_of_a_held_run_is_looked_at(studio: Studio) -> None:
    studio.at("axis-strip").click()  # in the middle of the run, where Turn is ticked
    expect(studio.at("time-axis")).to_have_attribute("data-past", "true")
    expect(studio.at("held-banner")).to_have_count(0)
    expect(studio.page.locator("[data-held]")).to_have_count(0)
    past = studio.at("recorded-canvas")
    expect(past.get_by_test_id(f"node-{TURN}")).to_have_attribute("data-status", "RUNNING")
    the_hold_is_marked_on_the_axis(studio)
    studio.page.keyboard.press("Escape")
    expect(past).to_have_count(0)
    held_at(studio, CHECK, "it returned FAILURE")


def the_hold_is_marked_on_the_axis(studio: Studio) -> None:
    mark = studio.page.locator("[data-testid=axis-mark][data-kind=held]").first
    expect(mark).to_have_accessible_name(re.compile("Held at .*breakpoint"))
    mark.click()
    block = studio.at("recorded-canvas").get_by_test_id(f"node-{CHECK}")
    expect(block).to_have_attribute("data-selected", "true")
    studio.picture("past-hold")


def breakpoints_outlast_a_reload(studio: Studio) -> None:
    studio.page.reload()
    expect(studio.at(f"breakpoint-{CHECK}")).to_be_visible()
    held_at(studio, CHECK, "it returned FAILURE")


def the_line_is_found(studio: Studio) -> None:
    """By the mouse to the line that decides, and by keys onwards; the hold outlasts a reload."""
    studio.at(f"node-{CHECK}").click()
    studio.page.keyboard.press("F9")
    expect(studio.at(f"breakpoint-{CHECK}")).to_have_attribute("data-state", "none")
    studio.at("debug-continue").click()
    studio.expect_state("application_running")
    the_past_says_what_was_forced(studio)
    studio.open_file("actions/CheckObstacle.py")
    line = studio.page.locator(".cm-line", has_text="if self.nearest_ahead() <")
    press_beside(studio, line)
    held_at_line(studio, "by a breakpoint")
    expect(studio.at("python-block")).to_have_text("in “CheckObstacle”, below “Inverter”")
    studio.at("python-values").click()
    asks(studio, "self.nearest_ahead() < get_input(self, 'obs_dist')", "True")
    asks(studio, "get_input(self, 'obs_dist')", "50.0")  # the reason
    studio.picture("held-in-python")
    studio.page.reload()
    held_at_line(studio, "by a breakpoint")
    studio.page.keyboard.press("F10")
    held_at_line(studio, "since a step ended")
    line.click()
    studio.page.keyboard.press("F9")
    studio.page.keyboard.press("F5")
    studio.expect_state("application_running")
    expect(studio.at("python-banner")).to_have_count(0)


def the_past_says_what_was_forced(studio: Studio) -> None:
    """The tick is over in which it was."""
    studio.at("axis-strip").click()
    studio.page.keyboard.press("Alt+Shift+m")
    line = studio.at("axis-marks").locator("[data-testid=mark-line][data-kind=forced]")
    expect(line).to_contain_text("Forced from")
    line.get_by_role("button").first.click()
    block = studio.at("recorded-canvas").get_by_test_id(f"node-{CHECK}")
    expect(block).to_contain_text("forced: FAILURE")
    studio.picture("past-forced")
    studio.page.keyboard.press("Alt+Shift+m")
    studio.page.keyboard.press("Escape")
    expect(studio.at("recorded-canvas")).to_have_count(0)


def press_beside(studio: Studio, line: Locator) -> None:
    line.scroll_into_view_if_needed()
    text, gutter = line.bounding_box(), studio.page.locator(".cm-breakpoints").bounding_box()
    assert text is not None
    assert gutter is not None
    studio.page.mouse.click(gutter["x"] + gutter["width"] / 2, text["y"] + text["height"] / 2)


def held_at_line(studio: Studio, why: str) -> None:
    expect(studio.at("python-banner")).to_contain_text("Held in update at actions/CheckObstacle.py")
    expect(studio.at("python-banner")).to_contain_text(why)
    studio.expect_state("held")


def asks(studio: Studio, expression: str, answer: str) -> None:
    studio.at("python-expression").fill(expression)
    studio.at("python-expression").press("Enter")
    expect(studio.at("python-answer")).to_contain_text(answer)


def it_is_corrected_and_run_again(studio: Studio) -> None:
    studio.page.get_by_role("tab", name="MainTree", exact=True).click()
    studio.set_port(CHECK, "obs_dist", "1.0")
    studio.at("restart").click()
    # The press alone makes Run wait; the run before has the new value, too.
    expect(studio.at("run")).to_have_attribute("aria-disabled", "false")
    studio.expect_state("application_running")
    expect(studio.at("held-banner")).to_have_count(0)
    expect(studio.at("node-n6")).to_have_attribute("data-status", "RUNNING", timeout=120_000)


def all_breakpoints_are_switched_off_by_a_key(studio: Studio) -> None:
    studio.at(f"node-{INVERTER}").click()
    studio.page.keyboard.press("F9")
    expect(studio.at(f"breakpoint-{INVERTER}")).to_be_visible()
    held_at(studio, INVERTER, "before its tick")
    studio.page.keyboard.press("Control+Shift+F9")
    expect(studio.at(f"breakpoint-{INVERTER}")).to_have_attribute("data-state", "off")
    studio.at("debug-continue").click()
    studio.expect_state("application_running")
    expect(studio.at("held-banner")).to_have_count(0)
