"""The report of an evaluation in Chromium: it shows its data, and runs nothing foreign."""

from __future__ import annotations

from typing import TYPE_CHECKING

from playwright.sync_api import Browser, expect

from executor.evaluation.outcome import Outcome
from executor.evaluation.report import report_data, report_html
from executor.evaluation.summary import Summary
from executor.universes import parse_universe
from tests.executor.evaluation.projects import WORLD

if TYPE_CHECKING:
    from pathlib import Path

HOSTILE = "</script><img src=x onerror=\"document.title='taken'\"><svg onload=alert(1)>"


def outcome(seed: int) -> Outcome:
    name = ("success", "failure", "crashed")[seed % 3]
    item = {"item": HOSTILE, "holds": False, "at_s": 1.0, "margin": -0.5, "unit": "m"}
    return Outcome(
        seed,
        name,
        HOSTILE,
        seed / 10,
        items=[item] if name == "failure" else [],
        measures={"path_length_m": seed * 1.5, HOSTILE: 1.0},
        drawn={HOSTILE: HOSTILE},
        faults=[{"fault": HOSTILE, "at_s": 1.0, "until_s": None}],
        path=[[0.0, 0.0, 0.0], [1.0, seed / 20, 1.0]],
        bumps=[[1.0, 2.0, seed / 20, HOSTILE]] if name == "failure" else [],
        seen={HOSTILE: "SR", "never ticked": ""},
    )


def test_the_report_shows_hostile_text_as_text(browser: Browser, tmp_path: Path) -> None:
    summary = Summary(tuple(outcome(seed) for seed in range(60)), 60)
    data = report_data(
        summary,
        parse_universe(WORLD),
        project=HOSTILE,
        path=HOSTILE,
        evaluation=HOSTILE,
        gates=[(HOSTILE, False)],
        fingerprints=[HOSTILE],
    )
    (tmp_path / "report.html").write_text(report_html(data), encoding="utf-8")
    context = browser.new_context(color_scheme="dark")
    shown = context.new_page()
    asked: list[str] = []
    said: list[str] = []
    shown.on("request", lambda request: asked.append(request.url))
    shown.on("console", lambda message: said.append(message.text))
    shown.on("pageerror", lambda error: said.append(str(error)))
    shown.goto((tmp_path / "report.html").as_uri())
    expect(shown.get_by_role("heading", level=1)).to_have_text(HOSTILE)
    expect(shown.get_by_text("20 of 60 runs")).to_be_visible()
    expect(shown.locator("svg rect.fill-failure title").first).to_contain_text(HOSTILE)
    expect(shown.locator("polyline")).to_have_count(60)
    expect(shown.locator("main img, main script")).to_have_count(0)
    expect(shown).to_have_title(f"{HOSTILE} · {HOSTILE}")
    shown.get_by_text("seed 1:", exact=False).last.focus()
    shown.set_viewport_size({"width": 390, "height": 800})
    wide = shown.evaluate("document.documentElement.scrollWidth")
    assert wide <= 390
    assert (len(asked), said) == (1, [])
    context.close()
