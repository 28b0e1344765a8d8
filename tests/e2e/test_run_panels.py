"""The panels beside the tree during a run: timeline, topics, ROS tools."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser, Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


def test_a_run_is_followed_beside_the_tree(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.new_from("laser_bump_and_go")
    studio.run()
    timeline_tells_what_nodes_did(studio)
    topics_are_heard_and_plotted(studio)
    ros_tools_get_the_environment(studio)
    a_window_outlives_a_reload_and_goes_with_the_page(studio)


def timeline_tells_what_nodes_did(studio: Studio) -> None:
    panel(studio, "Timeline")
    forward = row(studio, "Forward")
    expect(forward).to_have_attribute("aria-label", re.compile(r"running; ran"))
    forward.focus()
    studio.page.keyboard.press("ArrowUp")
    expect(studio.page.locator(":focus")).to_have_attribute("aria-label", re.compile("^Turn"))
    studio.page.keyboard.press("Enter")
    expect(studio.at("inspector")).to_have_attribute("aria-label", "Turn")
    forward.click()
    expect(studio.at("node-statistics").locator("[data-key=runs] dd")).not_to_have_text("0")
    # The click may have been on a bar, which shows its moment.
    studio.page.keyboard.press("Escape")
    expect(studio.at("sim-stats")).to_be_visible()
    pictures(studio, "timeline")


def topics_are_heard_and_plotted(studio: Studio) -> None:
    panel(studio, "Topics")
    odometry = studio.at("topic-/odom")
    expect(odometry).to_have_attribute("data-hz", re.compile(r"[1-9]"))
    expect(odometry).to_contain_text("nav_msgs/Odometry")
    expect(odometry).to_contain_text("kB/s")
    odometry.get_by_role("button").click()
    echo = studio.at("echo-/odom")
    expect(echo).to_have_attribute("data-count", re.compile(r"[1-9]"))
    echo.get_by_label("Plot pose.pose.position.x").click()
    expect(studio.at("plot").locator("canvas")).to_be_visible()
    pictures(studio, "topics")


def ros_tools_get_the_environment(studio: Studio) -> None:
    studio.page.get_by_role("button", name="Connect ROS tools…").click()
    environment = studio.at("ros-environment")
    expect(environment).to_contain_text("export ROS_DOMAIN_ID=")
    studio.page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    studio.at("connect-ros").get_by_role("button", name="Copy").click()
    # The button says so for a second, which a busy machine misses.
    read = "navigator.clipboard.readText()"
    wait_until(lambda: studio.page.evaluate(read) == environment.inner_text(), "it is copied")
    studio.page.keyboard.press("Escape")
    expect(studio.at("connect-ros")).to_be_hidden()


def a_window_outlives_a_reload_and_goes_with_the_page(studio: Studio) -> None:
    page = studio.page
    first = studio.pop_out("timeline")
    expect(first.get_by_test_id("timeline")).to_be_visible()
    with page.expect_popup() as again:
        page.reload()
    window = again.value
    expect(
        window.get_by_test_id("timeline").get_by_role("button", name=re.compile("^Forward,"))
    ).to_be_visible()
    assert first.is_closed()
    studio.expect_state("application_running")
    studio.end_session()
    with window.expect_event("close"):
        page.close(run_before_unload=True)


def row(studio: Studio, name: str) -> Locator:
    """Returns a node's row of the timeline."""
    return studio.at("timeline").get_by_role("button", name=re.compile(f"^{name},"))


def panel(studio: Studio, name: str) -> None:
    """Brings a panel to the front."""
    studio.page.get_by_role("tab", name=name, exact=True).click()


def pictures(studio: Studio, name: str) -> None:
    """Stores a picture in each theme."""
    studio.picture(f"run-{name}-light")
    studio.at("theme-toggle").click()
    studio.page.wait_for_timeout(400)  # the theme fades in; the picture is for people
    studio.picture(f"run-{name}-dark")
    studio.at("theme-toggle").click()
