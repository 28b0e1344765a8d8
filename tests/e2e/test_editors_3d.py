"""The editors of universes and robots by hand: mouse and keyboard, the text in step, and a run."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

CRATE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


def text_of(studio: Studio, path: str) -> str:
    """A file of the project as the server has it."""
    studio.saved()
    project = studio.page.url.rstrip("/").split("/")[-1]
    answer = studio.page.request.get(f"{studio.server.origin}/api/v1/projects/{project}/files/{path}")
    assert answer.ok, answer.text()
    return answer.text()


def field(panel: Locator, test_id: str, value: str) -> None:
    """Types a number or a word into a field of a panel."""
    panel.get_by_test_id(test_id).fill(value)
    panel.get_by_test_id(test_id).press("Enter")


def new(studio: Studio, kind: str, base: str, name: str) -> None:
    """Makes a universe or a robot through its dialogue."""
    studio.at(f"new-{kind}").click()
    studio.at(f"choice-{base}").click()
    studio.at(f"new-{kind}-name").fill(name)
    studio.at(f"new-{kind}-ok").click()
    expect(studio.at(f"{kind}-view").locator("canvas")).to_be_visible()


def change_a_universe(studio: Studio) -> None:
    new(studio, "universe", "empty", "yard")
    studio.at("place-crate").click()
    field(studio.at("thing-fields"), "field-x", "2")
    studio.at("universe-view").focus()
    studio.page.keyboard.press("ArrowUp")
    studio.page.keyboard.press("q")
    assert "crate" in text_of(studio, "universes/yard.yaml")
    turned = text_of(studio, "universes/yard.yaml")
    studio.page.keyboard.press("Control+z")
    assert text_of(studio, "universes/yard.yaml") != turned
    studio.at("redo").click()  # the top bar's: the universe is in front
    assert text_of(studio, "universes/yard.yaml") == turned
    studio.at("mesh-file").set_input_files(
        files=[{"name": "rock.obj", "mimeType": "text/plain", "buffer": CRATE}]
    )
    expect(studio.at("thing-rock")).to_be_visible()
    studio.at("place-floor").click()
    studio.page.get_by_role("combobox", name="Texture").click()
    studio.page.get_by_role("option", name="Wood").click()
    assert "texture: wood" in text_of(studio, "universes/yard.yaml")


def change_a_robot(studio: Studio) -> None:
    new(studio, "robot", "template", "mine")
    field(studio.at("robot-fields"), "wheel-radius", "0.06")
    field(studio.at("robot-fields"), "wheel-track", "0.3")
    studio.at("thing-sensor scan").click()
    field(studio.at("part-fields"), "field-z", "0.25")
    field(studio.at("part-fields"), "value-range_max", "5")
    studio.at("robot-view").focus()
    studio.page.keyboard.press("PageUp")
    urdf = text_of(studio, "robots/mine/robot.urdf")
    assert '<origin xyz="0 0 0.255"/>' in urdf
    assert '<sphere radius="0.06"/>' in urdf
    config = text_of(studio, "robots/mine/robot.yaml")
    assert "range_max: 5\n" in config
    assert "track: 0.3\n" in config
    assert "# What may touch the floor" in config
    studio.at("add-imu").click()
    expect(studio.at("thing-sensor imu")).to_have_attribute("aria-selected", "true")
    studio.at("undo").click()
    expect(studio.at("thing-sensor imu")).to_have_count(0)
    studio.at("robot-text").click()
    studio.page.get_by_text("robot.urdf", exact=True).last.click()
    expect(studio.at("code-editor")).to_have_attribute("data-path", "robots/mine/robot.urdf")


def test_a_universe_and_a_robot_are_made_by_hand_and_run(studio: Studio):
    studio.new_from("laser_bump_and_go")
    change_a_universe(studio)
    expect_accessible(studio, "light")
    change_a_robot(studio)
    expect_accessible(studio, "light")
    studio.picture("robot-editor-light")
    expect_accessible(studio, "dark")
    studio.picture("robot-editor-dark")
    studio.at("robot-editor").get_by_test_id("run-here").click()
    studio.expect_state("application_running")
    studio.end_session()
