"""The messages of a run have a place of their own and leave with an edit; both ways to start the program."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

FAILS = """\
import py_trees


class Forward(py_trees.behaviour.Behaviour):
    def update(self):
        print("I begin")
        raise ValueError("no wheels")
"""
WORKS = FAILS.replace('raise ValueError("no wheels")', "return py_trees.common.Status.RUNNING")


def test_messages_have_a_place_of_their_own(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.open_file("actions/Forward.py")
    studio.replace_code(FAILS)
    a_fault_moves_and_covers_nothing(studio)
    the_first_edit_answers_it(studio)
    the_program_is_restarted_where_the_robot_stands(studio)
    a_changed_program_is_applied_while_it_runs(studio)
    a_message_moves_the_robot_only_while_the_world_runs(studio)
    studio.end_session()


def top_of_the_dock(studio: Studio) -> float:
    box = studio.page.get_by_role("main").bounding_box()
    assert box
    return box["y"]


def a_fault_moves_and_covers_nothing(studio: Studio) -> None:
    before = top_of_the_dock(studio)
    studio.at("run").click()
    expect(studio.at("run-progress")).to_be_visible()
    assert top_of_the_dock(studio) == before
    banner = studio.at("banner")
    expect(banner).to_contain_text("no wheels")
    expect(studio.at("executor-state")).to_have_text("Stopped: fault")
    assert top_of_the_dock(studio) == before
    expect(studio.page.get_by_role("tooltip")).to_have_count(0)
    studio.picture("strip")
    studio.at("all-messages").click()
    whole = studio.at("strip-message")
    expect(whole).to_contain_text("no wheels")
    studio.page.keyboard.press("Escape")
    expect(whole).to_have_count(0)


def the_first_edit_answers_it(studio: Studio) -> None:
    studio.replace_code(WORKS)
    expect(studio.at("banner")).to_have_count(0)


def the_program_is_restarted_where_the_robot_stands(studio: Studio) -> None:
    """*Run* resets the world; *Restart the program here* keeps it, also after a stop."""
    studio.run()
    expect(studio.at("console").get_by_role("separator", name="Run 2")).to_be_visible()
    studio.at("stop").click()
    studio.expect_state("visualization_ready")
    stopped = studio.stat("t")
    studio.at("run").hover()
    expect(studio.page.get_by_role("tooltip")).to_contain_text("resets the world")
    studio.at("restart").hover()
    expect(studio.page.get_by_role("tooltip")).to_contain_text("the world stays")
    studio.at("restart").click()
    studio.expect_state("application_running")
    wait_until(lambda: studio.stat("t") > stopped, "the world continued")


def a_changed_program_is_applied_while_it_runs(studio: Studio) -> None:
    """The world and the other blocks continue; it asks before it halts what runs."""
    before = studio.stat("t")
    studio.replace_code(WORKS.replace("I begin", "I was changed"))
    offer = studio.at("restart-offer")
    expect(offer).to_be_visible()
    studio.picture("apply-offer")
    offer.get_by_role("button", name="Apply").click()
    plan = studio.at("apply-plan")
    expect(plan).to_contain_text("Running, and halted now:")
    expect(plan).to_contain_text("Forward")
    expect(studio.at("apply-anyway")).to_be_focused()
    studio.picture("apply-plan")
    studio.page.keyboard.press("Enter")
    expect(studio.at("console")).to_contain_text("I was changed")
    expect(offer).to_have_count(0)
    assert studio.stat("t") > before
    expect(studio.at("console").get_by_role("separator", name="Run 4")).to_have_count(0)
    studio.expect_state("application_running")


def a_message_moves_the_robot_only_while_the_world_runs(studio: Studio) -> None:
    """Enter in a field sends nothing; a paused world is named, and may run without a program."""
    keys = studio.page.keyboard
    studio.at("stop").click()
    studio.expect_state("visualization_ready")
    studio.page.get_by_role("tab", name="Topics", exact=True).click()
    studio.at("topics").get_by_role("button", name="Publish…").click()
    form = studio.at("publish")
    form.get_by_label("Topic").fill("/cmd_vel")
    form.get_by_label("Type").fill("geometry_msgs/msg/Twist")
    expect(form).to_contain_text("angular: geometry_msgs/Vector3")
    form.get_by_label("Message").fill('{"linear": {"x": 0.4}}')
    publish, told = form.get_by_role("button", name="Publish once"), form.get_by_text("was published")
    publish.click()
    expect(form.get_by_test_id("paused-world")).to_contain_text("The world is paused.")
    expect(told).to_have_count(0)
    form.get_by_role("button", name="Let the world run").click()
    expect(form.get_by_test_id("paused-world")).to_have_count(0)
    before = studio.stat("distance")
    form.get_by_label("Topic").click()
    keys.press("Enter")
    expect(told).to_have_count(0)
    keys.press("Control+Enter")
    expect(told).to_be_visible()
    wait_until(lambda: studio.stat("distance") > before, "the robot heard it")
    form.get_by_role("button", name="Close").click()
    strip = studio.at("world-runs")
    expect(strip).to_contain_text("The world runs without a program.")
    studio.picture("world-runs")
    strip.get_by_role("button", name="Pause the world").click()
    expect(strip).to_have_count(0)
