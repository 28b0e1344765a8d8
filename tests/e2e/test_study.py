"""The end of a study in the page: its picture, and its best values as an edit of the tree."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible, expect_to_fit

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from playwright.sync_api import Browser

    from tests.e2e.studio import Studio

pytestmark = pytest.mark.e2e
ADDRESS = "MainTree.Forward.lin_speed"
SIDE = {"rate": 0.5, "low": 0.3, "high": 0.7, "successes": 20, "counted": 40}


def study() -> bytes:
    """Returns the file that `bt-studio tune` writes, of the speed in *bump and go*."""
    port = {
        "address": ADDRESS,
        "tree": "MainTree",
        "node": "n6",
        "port": "lin_speed",
        "low": 0.1,
        "high": 0.6,
    }
    ratings = (0.4, 0.5, 0.3, 0.8, 0.7, 0.95)
    best = {**SIDE, "rate": 0.95, "low": 0.83, "high": 0.99, "rating": 0.95, "difference": [0.45, 0.28, 0.6]}
    document = {
        "format": "bt-studio/tuning",
        "version": 1,
        "project": "Bump and go",
        "evaluation": "room, tuned",
        "objective": "success",
        "maximise": True,
        "ports": [port],
        "trials": [
            {"number": n, "values": {ADDRESS: 0.1 + n / 10}, "rating": rating}
            for n, rating in enumerate(ratings)
        ],
        "today": {"values": {ADDRESS: "0.3"}, **SIDE, "rating": 0.5, "difference": None},
        "best": [{"values": {ADDRESS: 0.45}, "texts": {ADDRESS: "0.45"}, **best}],
        "improvement": True,
        "verdict": "",
    }
    return json.dumps(document).encode()


def test_the_best_values_of_a_study_are_one_edit(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser, tmp_path: Path
) -> None:
    studio = open_studio(browser_without_webgl)
    page = studio.page
    studio.new_from("laser_bump_and_go")
    page.get_by_role("tab", name="Evaluate", exact=True).click()
    panel = studio.at("evaluate")
    (tmp_path / "tuning.json").write_bytes(study())
    with page.expect_file_chooser() as chooser:
        panel.get_by_role("button", name="Open a tuning…").click()
    chooser.value.set_files(tmp_path / "tuning.json")
    shown = panel.get_by_role("region", name="Tuning: room, tuned")
    expect(shown.get_by_role("status")).to_contain_text("An improvement is shown")
    expect(shown.get_by_role("img", name="success by trial")).to_be_visible()
    studio.picture("study")
    block = studio.at("node-n6").first
    expect(block).to_contain_text("0.3")
    shown.get_by_role("button", name="Use these values").press("Enter")
    expect(block).to_contain_text("0.45")
    expect(shown.get_by_role("row", name="Best 1")).to_contain_text("in the trees")
    studio.saved()
    page.get_by_role("button", name="Undo").last.click()
    expect(block).to_contain_text("0.3")
    page.set_viewport_size({"width": 390, "height": 844})
    studio.command("Evaluate")
    expect_accessible(studio, "dark")
    expect_to_fit(page, "a study")
    studio.picture("study-narrow")
