"""A robot with two cameras, made by hand: each is chosen and seen, several at once."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(300)]


def test_every_camera_of_a_robot_is_seen(studio: Studio) -> None:
    page = studio.page
    studio.new_from("laser_bump_and_go")
    a_second_camera_is_added(studio)
    studio.at("robot-editor").get_by_test_id("run-here").click()
    studio.expect_state("application_running")

    page.get_by_role("tab", name="Camera", exact=True).click()
    view = studio.at("viewer-camera")
    choice = view.get_by_label("Camera of this view")
    expect(choice).to_have_value("camera")
    expect(view.locator("canvas")).to_have_attribute("data-frames", re.compile(r"\d"))
    choice.select_option("camera_2")
    expect(view).to_have_attribute("data-camera", "camera_2")
    expect(view.get_by_test_id("camera-figures")).to_be_visible()
    expect(page.get_by_role("tab", name="Camera · camera_2")).to_be_visible()

    view.get_by_role("button", name="Open one more camera view").click()
    expect(view).to_have_count(2)
    for name in ("camera", "camera_2"):
        shown = page.locator(f"[data-testid=viewer-camera][data-camera={name}]")
        expect(shown.locator("canvas")).to_have_attribute("data-frames", re.compile(r"\d\d"))
    studio.picture("two-cameras")

    page.reload()
    expect(page.locator("[data-camera=camera], [data-camera=camera_2]")).to_have_count(2)
    first = page.get_by_role("tab", name="Camera · camera", exact=True)
    first.locator(".flexlayout__tab_button_trailing").click()
    expect(view).to_have_count(1)
    expect(view).to_have_attribute("data-camera", "camera_2")
    studio.end_session()


def a_second_camera_is_added(studio: Studio) -> None:
    """In the robot editor, on a robot of the project."""
    studio.at("new-robot").click()
    studio.at("choice-template").click()
    studio.at("new-robot-name").fill("watcher")
    studio.at("new-robot-ok").click()
    expect(studio.at("thing-sensor camera")).to_be_visible()
    studio.at("add-camera").click()
    studio.page.keyboard.press("Enter")
    expect(studio.at("thing-sensor camera_2")).to_have_attribute("aria-selected", "true")
    studio.saved()
