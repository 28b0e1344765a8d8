"""A custom robot drives in a custom room, both made by fields in a browser without WebGL."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser

    from tests.e2e.observer import Observer
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(300)]


def test_an_own_robot_drives_in_an_own_room(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.new_from("laser_bump_and_go")
    a_room_with_a_crate_is_made(studio)
    a_robot_is_made(studio)
    both_are_chosen(studio)
    studio.run()
    observer = studio.observe()
    wait_until(lambda: position(observer, "robot")[0] > 0.5, "the robot drives towards the crate")
    assert position(observer, "crate") == pytest.approx((3, 0), abs=0.05)
    assert studio.stat("collisions") == 0
    observer.close()
    studio.end_session()


def position(observer: Observer, body: str) -> tuple[float, float]:
    """Returns where a body is, in m; far away while nothing is known."""
    track = observer.track(body)
    return track[-1][1:] if track else (0.0, 0.0)


def a_room_with_a_crate_is_made(studio: Studio) -> None:
    studio.at("new-universe").click()
    studio.at("choice-empty").click()
    studio.at("new-universe-name").fill("yard")
    studio.at("new-universe-ok").click()
    studio.at("place-crate").click()
    the_crate_is_put_to(studio, "3")


def the_crate_is_put_to(studio: Studio, x: str) -> None:
    for name, value in (("x", x), ("y", "0")):
        field = studio.at("thing-fields").get_by_test_id(f"field-{name}")
        field.fill(value)
        field.press("Enter")
    studio.saved()


def a_robot_is_made(studio: Studio) -> None:
    studio.at("new-robot").click()
    studio.at("choice-template").click()
    studio.at("new-robot-name").fill("mine")
    studio.at("new-robot-ok").click()
    expect(studio.at("robot-view").get_by_role("note")).to_contain_text("WebGL")
    radius = studio.at("robot-fields").get_by_test_id("wheel-radius")
    radius.fill("0.06")
    radius.press("Enter")
    studio.saved()
    studio.picture("own-robot-without-webgl")


def both_are_chosen(studio: Studio) -> None:
    """By their cards, beside those that are built in; the choice stays with the project."""
    studio.at("open-worlds").click()
    studio.at("choice-yard").click()
    studio.at("choice-mine").click()
    studio.picture("own-world-chosen")
    studio.at("choose-world").click()
    expect(studio.at("open-worlds")).to_contain_text("Yard")
    studio.saved()
    studio.page.reload()
    expect(studio.at("open-worlds")).to_contain_text("Yard")
