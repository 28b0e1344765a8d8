"""The statuses of the last tick stay: after the end, after a stop, and from step to step."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, focused
from tests.e2e.test_hands_build import quick

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


def test_the_last_tick_stays(studio: Studio) -> None:
    a_tree_that_waits_and_fails(studio)
    studio.at("run").click()
    the_end_names_the_block_that_failed(studio)
    the_timeline_has_its_row(studio)
    each_step_shows_what_its_tick_did(studio)
    studio.end_session()


def a_tree_that_waits_and_fails(studio: Studio) -> None:
    studio.at("new-from-empty").click()
    focused(studio, "canvas")
    quick(studio, "Tab", "Sequence")
    quick(studio, "Tab", "Sleep")
    studio.at("port-msec").fill("300")
    studio.at("port-msec").press("Enter")
    studio.at("canvas").focus()
    quick(studio, "Control+Enter", "AlwaysFailure")
    studio.saved()


def shows(studio: Studio, type_: str, status: str) -> None:
    expect(block(studio, type_)).to_have_attribute("data-past", status)


def the_end_names_the_block_that_failed(studio: Studio) -> None:
    banner = studio.at("banner")
    expect(banner).to_contain_text("The run failed at AlwaysFailure.")
    studio.expect_state("visualization_ready")
    shows(studio, "Sequence", "FAILURE")
    shows(studio, "Sleep", "SUCCESS")
    shows(studio, "AlwaysFailure", "FAILURE")
    studio.picture("last-tick")
    block(studio, "Sleep").click()
    banner.get_by_role("button", name="Show the block").click()
    expect(block(studio, "AlwaysFailure")).to_have_attribute("data-selected", "true")


def the_timeline_has_its_row(studio: Studio) -> None:
    """Its strip has the colour of a failure at the end of the run."""
    studio.page.get_by_role("tab", name="Timeline", exact=True).click()
    statistics = studio.at("node-statistics")
    expect(statistics.locator("[data-key=failures] dd")).to_have_text("1")


def each_step_shows_what_its_tick_did(studio: Studio) -> None:
    """A pause keeps the statuses, and a stop shows in pale what was running."""
    block(studio, "Sleep").click()
    studio.page.get_by_role("tab", name="Inspector", exact=True).click()
    studio.at("port-msec").fill("60000")
    studio.at("port-msec").press("Enter")
    studio.saved()
    studio.run()
    expect(block(studio, "AlwaysFailure")).not_to_have_attribute("data-past", "FAILURE")
    studio.page.get_by_role("tab", name="Blackboard", exact=True).click()
    expect(studio.at("blackboard")).to_have_text("This tree shares no keys.")
    studio.at("pause").click()
    studio.expect_state("paused")
    studio.at("step").click()
    expect(block(studio, "Sleep")).to_have_attribute("data-status", "RUNNING")
    studio.at("stop").click()
    studio.expect_state("visualization_ready")
    expect(studio.at("executor-state")).to_have_text("Stopped")
    shows(studio, "Sleep", "RUNNING")
    expect(studio.at("banner")).to_have_count(0)
