"""A robot is imported, looked at and taken back by keys alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.deadline import wait_until
from tests.e2e.test_dragged_parts import CART, looks_right, revisions, written
from translator.archive import read_folder
from translator.package.zip import write_zip

if TYPE_CHECKING:
    from pathlib import Path

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


def choose(studio: Studio, path: Path) -> None:
    """Presses the focused button for files, and chooses one."""
    expect(studio.at("import-files")).to_be_focused()
    with studio.page.expect_file_chooser() as chooser:
        studio.page.keyboard.press("Enter")
    chooser.value.set_files(path)


def tab_to(studio: Studio, test_id: str, key: str = "Tab") -> None:
    """Moves the focus until it is at an element, which must be reached within the dialogue."""
    for _ in range(60):
        if studio.at(test_id).evaluate("element => element === document.activeElement"):
            return
        studio.page.keyboard.press(key)
    raise AssertionError(f"{test_id} cannot be reached by {key}")


def test_a_robot_comes_in_and_goes_by_keys_alone(studio: Studio, tmp_path: Path) -> None:
    page = studio.page
    studio.may_be_refused(r"422 POST /api/v1/projects/[^/]+/imports")
    # The browser hands choosers over from now on: a key opens one sooner than a listener would be there.
    page.on("filechooser", lambda _: None)
    studio.new_from("laser_bump_and_go")
    studio.saved()
    before = revisions(studio)
    cart = tmp_path / "cart.zip"
    folder = written(tmp_path, CART)
    cart.write_bytes(write_zip(read_folder(folder)))
    nothing = tmp_path / "notes.yaml"
    nothing.write_text("a: 1\n", encoding="utf-8")

    studio.command("Import a robot")
    looks_right(studio, "keys-choose")
    choose(studio, nothing)
    expect(page.get_by_text("There is no robot, world or map in these files.")).to_be_visible()
    looks_right(studio, "keys-nothing")
    expect(page.get_by_role("button", name="Choose other files")).to_be_focused()
    page.keyboard.press("Enter")
    choose(studio, cart)
    expect(studio.at("import-name")).to_be_focused()
    page.keyboard.press("Control+a")
    page.keyboard.type("trolley")
    looks_right(studio, "keys-options")
    tab_to(studio, "import-take")
    page.keyboard.press("Enter")
    expect(studio.at("test-drive").get_by_role("listitem")).to_have_count(2)
    looks_right(studio, "keys-report")
    expect(studio.at("import-open")).to_be_focused()
    assert revisions(studio) == before + 1

    tab_to(studio, "import-undo", "Shift+Tab")
    page.keyboard.press("Enter")
    expect(page.get_by_role("dialog")).to_have_count(0)
    expect(studio.at("file-robots/trolley/robot.yaml")).to_have_count(0)
    wait_until(lambda: revisions(studio) == before + 2, "the import is taken back")
    studio.saved()
    studio.picture("keys-undone")
