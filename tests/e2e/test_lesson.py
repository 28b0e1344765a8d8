"""A first user opens an example from its card and works through its lesson."""

from __future__ import annotations

from typing import TYPE_CHECKING

from playwright.sync_api import expect

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

LESSONS_OPEN = """localStorage.removeItem("bts.lessons")"""


def is_wide(part: Locator) -> bool:
    """Returns whether a document has the width for its use."""
    box = part.bounding_box()
    return box is not None and box["width"] > 600


def test_a_lesson_sets_a_port_that_undo_takes_back_and_speaks_spanish(studio: Studio) -> None:
    page = studio.page
    page.add_init_script(LESSONS_OPEN)
    studio.open()
    card = studio.at("new-from-laser_bump_and_go")
    expect(card).to_contain_text("First steps")
    expect(card.locator("img")).to_be_visible()
    card.click()
    lesson = studio.at("lesson")
    expect(lesson.get_by_role("heading", name="Bump and go")).to_be_visible()
    expect(studio.at("node-n1")).to_be_visible()

    lesson.get_by_role("button", name="speed 0.15 m/s").click()
    speed = studio.at("node-n6")
    expect(speed).to_contain_text("0.15")
    expect(lesson.get_by_role("status")).to_contain_text("lin_speed of “Forward” is now 0.15")
    page.keyboard.press("Control+z")
    expect(speed).not_to_contain_text("0.15")

    # Neither tree nor code gets narrower; the inspector takes its turn when a block is selected.
    assert is_wide(studio.at("canvas"))
    studio.at("node-n5").click()
    expect(studio.at("inspector")).to_be_visible()
    expect(lesson).to_be_hidden()
    studio.at("canvas").locator(".react-flow__pane").click(position={"x": 20, "y": 200})
    expect(lesson).to_be_visible()

    lesson.get_by_role("button", name="nearest distance ahead").click()
    expect(page.get_by_role("tab", name="CheckObstacle.py")).to_be_visible()
    code = page.locator(".cm-editor").first
    expect(code).to_be_visible()
    assert is_wide(code)
    lesson.get_by_role("button", name="Run it").click()
    studio.expect_state("application_running")
    studio.at("stop").click()
    assert studio.complaints == []


def test_a_lesson_is_there_in_spanish(studio: Studio) -> None:
    page = studio.page
    page.add_init_script(LESSONS_OPEN + """;localStorage.setItem("bts.language", "es")""")
    studio.open()
    studio.at("new-from-push_box").click()
    lesson = studio.at("lesson")
    expect(lesson.get_by_role("heading", name="Empuja una caja a la meta")).to_be_visible()
    lesson.get_by_role("button", name="1 m", exact=True).click()
    expect(lesson.get_by_role("status")).to_contain_text("distance de «back off» vale ahora -1.0")
    assert studio.complaints == []
