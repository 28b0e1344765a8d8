"""The first task of a new user: three marks, each until the user has done it by hand."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.studio import Studio

if TYPE_CHECKING:
    from playwright.sync_api import Browser

    from tests.e2e.server import Server

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


def test_the_first_task_follows_the_user(server: Server, browser: Browser) -> None:
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    studio = Studio(context.new_page(), server, is_guided=True, is_basic=True)
    studio.open()
    studio.at("new-from-empty").click()
    a_block_is_dropped(studio)
    its_port_is_set(studio)
    it_runs(studio)
    it_is_over_and_can_be_shown_again(studio)
    context.close()
    assert studio.complaints == []


def at_step(studio: Studio, step: str) -> None:
    expect(studio.at("guide")).to_have_attribute("data-step", step)
    expect(studio.at("guide-ring")).to_be_visible()


def a_block_is_dropped(studio: Studio) -> None:
    at_step(studio, "block")
    expect_accessible(studio, "dark")
    studio.picture("first-task-block")
    expect_accessible(studio, "light")
    studio.page.get_by_label("Search nodes").fill("Sleep")
    studio.at("palette-Sleep").drag_to(studio.at("ghost-block"))


def its_port_is_set(studio: Studio) -> None:
    """It waits for Enter: a mark that goes while one types would take the eyes away."""
    at_step(studio, "fill")
    studio.picture("first-task-fill")
    field = studio.at("port-msec")
    field.fill("60000")
    at_step(studio, "fill")
    field.press("Enter")


def it_runs(studio: Studio) -> None:
    at_step(studio, "run")
    studio.picture("first-task-run")
    studio.run()
    expect(studio.page.get_by_text("Your first tree runs")).to_be_visible()
    expect(studio.at("guide")).to_have_count(0)


def it_is_over_and_can_be_shown_again(studio: Studio) -> None:
    studio.saved()
    studio.page.reload()
    expect(studio.at("canvas")).to_be_visible()
    expect(studio.at("guide")).to_have_count(0)
    studio.command("Show the first task")
    at_step(studio, "block")
    studio.at("guide").get_by_role("button", name="Skip the first task").first.click()
    expect(studio.at("guide")).to_have_count(0)
    studio.end_session()
