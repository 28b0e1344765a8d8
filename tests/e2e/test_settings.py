"""The settings of a project decide what a run starts, and what happens at its end."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, focused
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser, Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(300)]


@pytest.mark.long_walk
def test_a_run_follows_the_settings(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.at("new-from-empty").click()
    focused(studio, "canvas")
    add(studio, "Tab", "Sequence")
    add(studio, "Tab", "Sleep")
    studio.at("port-msec").fill("200")
    studio.saved()
    it_begins_again(studio)
    another_tree_is_started(studio)
    studio.end_session()


def add(studio: Studio, key: str, name: str) -> None:
    """Opens the quick-add box on the tree in front, and chooses the first result."""
    studio.page.keyboard.press(key)
    studio.writing()
    studio.page.keyboard.type(name)
    studio.page.keyboard.press("Enter")
    expect(studio.at("quick-add")).to_have_count(0)
    expect(studio.page.locator("[data-testid=canvas]:visible")).to_be_focused()


def settings(studio: Studio) -> Locator:
    studio.page.keyboard.press("Control+Comma")
    return studio.at("settings")


def keep(studio: Studio, form: Locator) -> None:
    form.get_by_role("button", name="Save").click()
    expect(form).to_have_count(0)
    studio.saved()


def choose(studio: Studio, form: Locator, label: str, option: str) -> None:
    form.get_by_role("combobox", name=label).click()
    studio.page.get_by_role("option", name=option, exact=True).click()


def it_begins_again(studio: Studio) -> None:
    """The tree is done after 0.2 s, and its run continues, ten times a second."""
    form = settings(studio)
    form.get_by_role("textbox", name="Description").fill("Waits, and waits again.")
    form.get_by_role("radio", name="Begin again").check()
    choose(studio, form, "Ticks a second", "10 Hz")
    keep(studio, form)
    studio.run()
    expect(studio.at("sim-stats")).to_contain_text("/ 100 ms")
    studio.page.get_by_role("tab", name="Timeline", exact=True).click()
    block(studio, "Sleep").click()
    runs = studio.at("node-statistics").locator("[data-key=runs] dd")
    wait_until(lambda: int(runs.inner_text() or 0) > 2, "the tree begins again")
    studio.expect_state("application_running")


def another_tree_is_started(studio: Studio) -> None:
    """Run starts the main tree, whichever is in front."""
    keys = studio.page.keyboard
    studio.command("new tree")
    studio.page.get_by_role("dialog").get_by_role("textbox").fill("Other")
    keys.press("Enter")
    other = studio.page.locator("[data-testid=canvas][data-tree=Other]")
    expect(other).to_be_focused()
    add(studio, "Tab", "Fallback")
    add(studio, "Tab", "AlwaysFailure")
    form = settings(studio)
    expect(form.get_by_role("textbox", name="Description")).to_have_value("Waits, and waits again.")
    choose(studio, form, "Tree that Run starts", "Other")
    form.get_by_role("radio", name="Stop", exact=True).check()
    keep(studio, form)
    studio.command("open tree maintree")
    studio.at("run").click()
    expect(studio.at("banner")).to_contain_text("The run failed at AlwaysFailure.")
    studio.expect_state("visualization_ready")
