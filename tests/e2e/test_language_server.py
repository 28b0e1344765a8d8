"""Python is written without its language server: it is missing, then it ends at once, then it is there."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import serving
from tests.e2e.studio import Studio
from tests.e2e.test_code import SOURCE, expect_help, line, spot

if TYPE_CHECKING:
    from playwright.sync_api import Browser

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]

FAKE = Path(__file__).parents[1] / "fakes" / "language_server.py"


def without_language_server(folder: Path) -> Path:
    """Makes a Python environment that has all of this one but the language server; returns its programs."""
    ours, programs = Path(sys.executable).parent, folder / "bin"
    programs.mkdir(parents=True)
    (folder / "pyvenv.cfg").write_text((ours.parent / "pyvenv.cfg").read_text())
    (folder / "lib").symlink_to(ours.parent / "lib")
    for name in ("python", "ruff"):
        (programs / name).symlink_to(ours / name)
    return programs


def test_python_is_written_without_its_language_server(tmp_path: Path, browser: Browser) -> None:
    programs = without_language_server(tmp_path / "environment")
    with serving(tmp_path, python=str(programs / "python")) as server:
        studio = Studio(browser.new_page(viewport={"width": 1440, "height": 900}), server)
        studio.open()
        studio.new_from("laser_bump_and_go")
        studio.open_file("actions/Forward.py")
        it_is_missing_and_the_rest_works(studio)
        it_ends_at_once_and_is_tried_again(studio, programs / "ty")
        studio.page.context.close()
        assert studio.complaints == [], "the browser's console must stay empty, and nothing is refused"


def it_is_missing_and_the_rest_works(studio: Studio) -> None:
    """The reason is said; ruff still finds, fixes and formats."""
    page, state = studio.page, studio.at("language-state")
    expect(state).to_have_attribute("data-state", "failed")
    expect(state).to_contain_text("The language server cannot be started: No such file or directory.")
    studio.picture("no-language-server")
    studio.replace_code(SOURCE)
    page.mouse.move(*spot(studio, "import os", "os"))
    page.get_by_role("button", name="Remove unused import: `os`").click()
    expect(line(studio, "import os")).to_have_count(0)
    page.keyboard.press("Control+s")
    expect(line(studio, "return py_trees")).to_be_visible()
    studio.saved()
    state.get_by_role("button", name="Try again").click()
    expect(state.get_by_role("button", name="Try again")).to_be_visible()
    expect(state).to_have_attribute("data-state", "failed")


def it_ends_at_once_and_is_tried_again(studio: Studio, program: Path) -> None:
    """The page tries again by itself, and has its help once the server stays."""
    new = program.with_name("new")
    new.write_text(f"#!/bin/sh\nexec {sys.executable} {FAKE} dies\n")
    new.chmod(0o755)
    new.replace(program)
    state = studio.at("language-state")
    state.get_by_role("button", name="Try again").click()
    expect(state).to_contain_text("The language server has ended. It starts again by itself.")
    new.symlink_to(Path(sys.executable).with_name("ty"))
    new.replace(program)
    expect_help(studio)
    studio.page.mouse.move(*spot(studio, "import Twist", "Twist"))
    expect(studio.page.locator(".cm-tooltip-hover")).to_contain_text("geometry_msgs/msg/Twist")
