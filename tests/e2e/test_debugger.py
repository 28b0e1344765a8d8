"""The debugger in the page: find out why *Turn* never ends, correct it, run again; by mouse and by keys."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

if TYPE_CHECKING:
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
    studio.at("axis-strip").click(position={"x": 5, "y": 5})
    expect(studio.at("time-axis")).to_have_attribute("data-past", "true")
    expect(studio.at("held-banner")).to_have_count(0)
    expect(studio.page.locator("[data-held]")).to_have_count(0)
    past = studio.at("recorded-canvas")
    expect(past.get_by_test_id(f"node-{TURN}")).to_have_attribute("data-status", "RUNNING")
    studio.page.keyboard.press("Escape")
    expect(past).to_have_count(0)
    held_at(studio, CHECK, "it returned FAILURE")


def breakpoints_outlast_a_reload(studio: Studio) -> None:
    studio.page.reload()
    expect(studio.at(f"breakpoint-{CHECK}")).to_be_visible()
    held_at(studio, CHECK, "it returned FAILURE")


def it_is_corrected_and_run_again(studio: Studio) -> None:
    studio.set_port(CHECK, "obs_dist", "1.0")
    studio.at(f"node-{CHECK}").click()
    studio.page.keyboard.press("F9")
    expect(studio.at(f"breakpoint-{CHECK}")).to_have_attribute("data-state", "none")
    studio.at("restart").click()
    studio.expect_state("application_running")
    expect(studio.at("held-banner")).to_have_count(0)
    expect(studio.at("node-n6")).to_have_attribute("data-status", "RUNNING", timeout=120_000)


def all_breakpoints_are_switched_off_by_a_key(studio: Studio) -> None:
    studio.at(f"node-{INVERTER}").click()
    studio.page.keyboard.press("F9")
    held_at(studio, INVERTER, "before its tick")
    studio.page.keyboard.press("Control+Shift+F9")
    expect(studio.at(f"breakpoint-{INVERTER}")).to_have_attribute("data-state", "off")
    studio.at("debug-continue").click()
    studio.expect_state("application_running")
    expect(studio.at("held-banner")).to_have_count(0)
