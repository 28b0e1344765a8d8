"""The Evaluate panel: runs find a fault, the worst one is looked at, the tree repaired, and both compared."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.budget import count
from tests.e2e.accessibility import expect_accessible, expect_no_findings, expect_to_fit

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser

    from tests.e2e.studio import Studio

RUNS = count("e2e_evaluated_runs")
SLOW_MS = 400_000 if RUNS < 50 else 1_500_000  # a busy machine takes 20 times as long
pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(3 * SLOW_MS // 1000)]
NEAR = f"""format: bt-studio/evaluation
version: 1
universe: walled_room
duration_s: 20
runs: {RUNS}
vary:
  robot.pose: {{area: middle, yaw: [-1.2, 1.2]}}
judge:
  success:
    - never: {{closer_than_m: 0.1, to: anything}}
  measure: [path_length_m, smallest_clearance_m]
"""
CHECK = "n4"  # looks for an obstacle ahead


@pytest.mark.long_walk
def test_a_fault_is_found_by_runs_seen_in_the_worst_repaired_and_compared(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    """The whole job. The fault: the robot notices what is in front of it from 0.1 m alone."""
    studio = open_studio(browser_without_webgl)
    studio.new_from("laser_bump_and_go")
    studio.set_port(CHECK, "obs_dist", "0.1")
    an_evaluation_is_written(studio)
    faulty = runs_are_evaluated(studio)
    before = revision(studio)
    assert faulty < 60
    the_worst_is_played_at_its_decision(studio)
    the_reason_is_found(studio)
    the_tree_is_corrected(studio)
    repaired = runs_are_evaluated(studio, before)
    assert repaired > faulty + 30
    the_repair_is_compared(studio, before)
    it_is_used_by_keys_in_a_narrow_dark_window(studio)


def an_evaluation_is_written(studio: Studio) -> None:
    studio.page.get_by_role("tab", name="Evaluate", exact=True).click()
    studio.at("evaluate").get_by_role("button", name="YAML").click()
    studio.replace_code(NEAR)
    studio.saved()


def runs_are_evaluated(studio: Studio, before: str = "none") -> float:
    """Evaluates a newer revision, waits for the end, and returns the rate of success in percent."""
    panel = studio.at("evaluate")
    panel.get_by_role("button", name="Evaluate", exact=True).click()
    title = panel.get_by_role("heading", name="Revision")
    expect(title).to_be_visible()
    expect(title).not_to_contain_text(f"Revision {before} ")
    expect(panel.get_by_text(f"{RUNS} of {RUNS} runs")).to_be_visible(timeout=SLOW_MS)
    expect(panel.get_by_role("button", name="Compare…")).to_be_visible(timeout=SLOW_MS)
    text = panel.get_by_test_id("evaluation-rate").inner_text()
    return float(text.partition("%")[0])


def the_worst_is_played_at_its_decision(studio: Studio) -> None:
    """By keys, from the list of the worst runs to the moment at which the run was decided."""
    panel, page = studio.at("evaluate"), studio.page
    worst = panel.get_by_role("region", name="The worst runs").get_by_role("listitem").first
    expect(worst).to_contain_text("never closer than 0.1 m to anything")
    worst.get_by_role("button", name=re.compile("^Seed")).click()
    cell = panel.get_by_test_id("evaluation-cell")
    expect(cell).to_contain_text(re.compile(r"^Seed \d+: failure after [\d.]+ s, margin -0\.\d+ m"))
    decided = re.search(r"after ([\d.]+) s", cell.inner_text())
    assert decided is not None
    panel.get_by_role("slider", name="Runs by seed").press("Enter")
    whole = decided[1].partition(".")[0]
    page.wait_for_url(re.compile(rf"\?run=[0-9a-f-]{{36}}&t={whole}\.\d+"), timeout=SLOW_MS)
    expect(studio.at("recorded-canvas")).to_be_visible()
    studio.picture("evaluate-played")


def the_reason_is_found(studio: Studio) -> None:
    """At that moment the robot still drives: its check saw no obstacle, and looks 0.1 m ahead."""
    canvas, page = studio.at("recorded-canvas"), studio.page
    expect(canvas.get_by_test_id("node-n6")).to_have_attribute("data-status", "RUNNING")
    canvas.get_by_test_id("node-n5").click(position={"x": 4, "y": 4})
    page.keyboard.press("Alt+w")
    expect(studio.at("why-question")).to_contain_text("not ticked")
    check = canvas.get_by_test_id(f"node-{CHECK}")
    check.click(position={"x": 4, "y": 4})
    expect(check).to_have_attribute("data-past", "FAILURE")
    expect(check).to_contain_text("0.1")
    studio.picture("evaluate-why")


def the_tree_is_corrected(studio: Studio) -> None:
    page = studio.page
    page.get_by_role("button", name="Live", exact=True).click()
    expect(studio.at("recorded-canvas")).to_have_count(0)
    page.get_by_role("tab", name="MainTree", exact=True).click()
    studio.set_port(CHECK, "obs_dist", "1.0")


def revision(studio: Studio) -> str:
    """Returns the revision of the evaluation that is shown."""
    title = studio.at("evaluate").get_by_role("heading", name="Revision").inner_text()
    found = re.search(r"Revision (\d+)", title)
    assert found is not None
    return found[1]


def the_repair_is_compared(studio: Studio, before: str) -> None:
    panel = studio.at("evaluate")
    panel.get_by_role("button", name="Compare…").click()
    expect(panel.get_by_role("combobox", name="With an older revision")).to_have_value(before)
    panel.get_by_role("button", name="Compare", exact=True).click()
    comparison = panel.get_by_test_id("evaluation-comparison")
    expect(comparison).to_contain_text("succeeds more often", timeout=SLOW_MS)
    expect(comparison.get_by_text("Only the newer one succeeds on the seeds")).to_be_visible()
    studio.picture("evaluate-compared")
    a_changed_run_is_played(studio, before)


def a_changed_run_is_played(studio: Studio, before: str) -> None:
    """A click on a seed of the comparison shows the older version's failure, then the present again."""
    panel, page = studio.at("evaluate"), studio.page
    sides = panel.get_by_role("radiogroup", name="Revision that is shown")
    sides.get_by_text(f"Revision {before}", exact=True).click()
    seed = panel.get_by_test_id("evaluation-comparison").get_by_role("button").first
    expect(panel.get_by_role("slider", name="Runs by seed")).to_be_visible()
    number = seed.inner_text()
    seed.click()
    expect(panel.get_by_test_id("evaluation-cell")).to_contain_text(f"Seed {number}: failure")
    page.wait_for_url(re.compile(r"\?run=[0-9a-f-]{36}&t="), timeout=SLOW_MS)
    expect(studio.at("recorded-canvas")).to_be_visible()
    page.get_by_role("button", name="Live", exact=True).click()
    expect(studio.at("recorded-canvas")).to_have_count(0)


def it_is_used_by_keys_in_a_narrow_dark_window(studio: Studio) -> None:
    """The focus never gets lost: where a control goes away, the keys continue at what came in its place."""
    panel, page = studio.at("evaluate"), studio.page
    page.set_viewport_size({"width": 390, "height": 844})
    studio.command("Evaluate")
    expect_accessible(studio, "dark")
    expect_to_fit(page, "evaluations")
    studio.picture("evaluate-narrow")
    panel.get_by_role("button", name="More about this evaluation").focus()
    page.keyboard.press("Enter")
    page.get_by_role("menuitem", name="Delete").press("Enter")
    expect(panel.get_by_role("button", name="Keep", exact=True)).to_be_focused()
    expect_no_findings(page, "evaluations, the question", "[data-testid=evaluate]")
    page.keyboard.press("Enter")
    expect(panel.locator(":focus")).to_have_count(1)
    a_replay_is_cancelled(studio)
    panel.get_by_role("button", name="New…").press("Enter")
    expect(panel.get_by_role("textbox", name="Name")).to_be_focused()
    page.keyboard.type("narrow")
    page.keyboard.press("Enter")
    expect(panel.get_by_role("button", name="Open the YAML beside")).to_be_focused()
    expect_no_findings(page, "evaluations, the form", "[data-testid=evaluate]")
    page.keyboard.press("Tab")
    page.keyboard.press("Enter")
    expect(panel.get_by_test_id("evaluation-form")).to_have_count(0)
    expect(panel.locator(":focus")).to_have_count(1)
    studio.saved()


def a_replay_is_cancelled(studio: Studio) -> None:
    panel, page = studio.at("evaluate"), studio.page
    panel.get_by_role("slider", name="Runs by seed").focus()
    page.keyboard.press("End")
    page.keyboard.press("Enter")
    panel.get_by_role("button", name="Cancel the replay").first.press("Enter")
    expect(panel.get_by_role("button", name="Cancel the replay")).to_have_count(0)
    expect(panel.locator(":focus")).to_have_count(1)
    page.wait_for_timeout(300)  # what was under way would still arrive
    assert "?run=" not in page.url
