"""Reports, studies and differences in Chromium: they show their data, and run nothing foreign."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from playwright.sync_api import Browser, Page, expect

from executor.evaluation.outcome import Outcome
from executor.evaluation.report import page_html, report_data, report_html
from executor.evaluation.summary import Summary
from executor.universes import parse_universe
from tests.executor.evaluation.projects import WORLD
from tests.shared.make_differences import OLDER, changed
from translator.difference.page import page
from translator.difference.picture import picture
from translator.difference.projects import Version, compare_versions

if TYPE_CHECKING:
    from collections.abc import Iterator
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


@contextmanager
def opened(browser: Browser, file: Path) -> Iterator[Page]:
    """Opens a file, and sees at the end that it asked for nothing else, and that no script complained."""
    context = browser.new_context(color_scheme="dark")
    shown = context.new_page()
    asked: list[str] = []
    said: list[str] = []
    shown.on("request", lambda request: asked.append(request.url))
    shown.on("console", lambda message: said.append(message.text))
    shown.on("pageerror", lambda error: said.append(str(error)))
    shown.goto(file.as_uri())
    yield shown
    assert (len(asked), said) == (1, [])
    context.close()


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
    with opened(browser, tmp_path / "report.html") as shown:
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


def test_a_study_shows_hostile_text_as_text(browser: Browser, tmp_path: Path) -> None:
    side = {"rating": 0.5, "rate": 0.5, "low": 0.3, "high": 0.7, "successes": 20, "counted": 40}
    data = {
        "project": HOSTILE,
        "evaluation": HOSTILE,
        "objective": HOSTILE,
        "maximise": True,
        "ports": [{"address": HOSTILE, "low": 0.1, "high": 0.6}],
        "trials": [{"number": n, "values": {HOSTILE: 0.1 + n / 10}, "rating": n / 4} for n in range(4)],
        "today": {"values": {HOSTILE: HOSTILE}, **side, "difference": None},
        "best": [{"values": {HOSTILE: 0.4}, **side, "difference": [0.1, 0.0, 0.2]}],
        "improvement": False,
        "verdict": HOSTILE,
    }
    (tmp_path / "tuned.html").write_text(page_html(data, "tuning"), encoding="utf-8")
    with opened(browser, tmp_path / "tuned.html") as shown:
        expect(shown.get_by_role("heading", level=1)).to_have_text(HOSTILE)
        expect(shown.get_by_role("row", name="today")).to_contain_text(HOSTILE)
        expect(shown.locator("svg circle title").first).to_contain_text(HOSTILE)
        expect(shown.locator("main img, main script")).to_have_count(0)
        expect(shown).to_have_title(f"{HOSTILE} · {HOSTILE}")


def test_a_difference_and_its_picture_show_hostile_text_as_text(browser: Browser, tmp_path: Path) -> None:
    newer = changed(a={"name": HOSTILE, "ports": {HOSTILE: HOSTILE}, "comment": HOSTILE})
    older = Version(HOSTILE, {HOSTILE: OLDER}, {HOSTILE: b"one\n"})
    found = compare_versions(older, Version(HOSTILE, {HOSTILE: newer}, {HOSTILE: HOSTILE.encode()}))
    (tmp_path / "difference.html").write_text(page(found), encoding="utf-8")
    (tmp_path / "difference.svg").write_text(picture(found.trees), encoding="utf-8")
    with opened(browser, tmp_path / "difference.html") as shown:
        expect(shown.get_by_role("listitem").first).to_contain_text(HOSTILE[:40])
        expect(shown.locator("pre").first).to_contain_text(f"+{HOSTILE}")
        expect(shown.locator("body img, body script")).to_have_count(0)
        expect(shown).not_to_have_title("taken")
    with opened(browser, tmp_path / "difference.svg") as shown:
        expect(shown.locator("text").filter(has_text="onerror").first).to_be_attached()
        expect(shown.locator("img, script, foreignObject")).to_have_count(0)
