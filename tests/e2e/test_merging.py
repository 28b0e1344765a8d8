"""Trees that were merged, and the page of a difference."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.test_hands_projects import drop, report, zipped
from tests.shared.make_differences import OLDER, changed
from tests.translator.conftest import EXAMPLES, ROOT
from translator.archive import read_folder
from translator.diagram import document_text
from translator.difference.page import page
from translator.difference.projects import Version, compare_versions
from translator.merge import merge_documents

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

TREE = "trees/MainTree.json"
HOSTILE = "</script><img src=x onerror=document.title='broken'>"


def conflicting_files() -> dict[str, bytes]:
    """The first example, whose two versions were merged: another speed on each side, and a renamed block."""
    files = dict(read_folder(ROOT / "examples" / EXAMPLES[0]))
    base = json.loads(files[TREE])
    speeds = [json.loads(json.dumps(base)) for _ in range(2)]
    for side, (speed, name) in zip(speeds, (("0.5", "calm"), ("0.1", HOSTILE)), strict=True):
        side["nodes"]["n6"]["ports"]["lin_speed"] = speed
        side["nodes"]["n1"]["name"] = name
    files[TREE] = document_text(merge_documents(base, *speeds).document).encode()
    return {f"merged/{path}": raw for path, raw in files.items()}


def test_conflicts_are_decided_in_the_editor(studio: Studio) -> None:
    studio.page.goto(studio.server.origin)
    drop(studio, "merged.zip", zipped(conflicting_files()))
    report(studio, "merged.zip")
    expect(studio.at("canvas")).to_be_visible()
    panel = studio.at("merge-conflicts")
    expect(panel.get_by_role("heading")).to_have_text("A merge has left 2 decisions")
    expect(panel).to_contain_text(HOSTILE)
    expect(panel.locator("img")).to_have_count(0)
    studio.picture("merge-conflicts-light")
    expect_accessible(studio, "dark")
    studio.picture("merge-conflicts-dark")
    expect_accessible(studio, "light")
    expect(studio.at("node-n6")).to_contain_text("0.5")

    speed = panel.get_by_role("listitem").filter(has_text="lin_speed")
    speed.get_by_role("button", name="Take theirs").click()
    expect(studio.at("node-n6")).to_contain_text("0.1")
    expect(panel.get_by_role("listitem")).to_have_count(1)
    panel.get_by_role("button", name="Keep ours").click()
    expect(panel).to_have_count(0)
    studio.saved()
    project = studio.page.url.rstrip("/").split("/")[-1]
    saved = studio.page.request.get(f"{studio.server.origin}/api/v1/projects/{project}/files/{TREE}").text()
    assert "conflicts" not in saved

    studio.at("canvas").press("Control+z")
    expect(panel.get_by_role("heading")).to_have_text("A merge has left 1 decision")
    studio.page.set_viewport_size({"width": 390, "height": 800})
    studio.picture("merge-conflicts-narrow")


def test_the_page_of_a_difference_runs_nothing(browser: Browser, tmp_path: Path) -> None:
    newer = changed(a={"name": HOSTILE, "ports": {HOSTILE: HOSTILE}, "comment": HOSTILE})
    sides = (
        Version(HOSTILE, {"MainTree": OLDER}),
        Version("new", {"MainTree": newer}, {HOSTILE: HOSTILE.encode()}),
    )
    (tmp_path / "difference.html").write_text(page(compare_versions(*sides)))
    context = browser.new_context()
    shown = context.new_page()
    asked: list[str] = []
    said: list[str] = []
    shown.on("request", lambda request: asked.append(request.url))
    shown.on("console", lambda message: said.append(message.text))
    shown.goto((tmp_path / "difference.html").as_uri())
    expect(shown.get_by_role("heading").first).to_contain_text(HOSTILE[:40])
    expect(shown.locator("svg")).to_have_count(1)
    expect(shown.locator("img, script")).to_have_count(0)
    expect(shown).to_have_title(f"{HOSTILE} → new")
    assert (len(asked), said) == (1, [])
    context.close()
