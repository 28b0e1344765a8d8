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


def test_messages_have_a_place_of_their_own(shared_studio: Studio) -> None:
    studio = shared_studio
    studio.new_from("laser_bump_and_go")
    studio.open_file("actions/Forward.py")
    studio.replace_code(FAILS)
    a_fault_moves_and_covers_nothing(studio)
    the_first_edit_answers_it(studio)
    the_program_is_restarted_where_the_robot_stands(studio)
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
