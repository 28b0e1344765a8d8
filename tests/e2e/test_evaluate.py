"""The Evaluate panel: runs of an example, the worst of them played, a repair, and the comparison."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(300)]
SLOW_MS = 120_000
STRICT = """format: bt-studio/evaluation
version: 1
universe: walled_room
duration_s: 3
runs: 6
vary:
  robot.pose: {area: middle, yaw: [0, 6.283]}
judge:
  success:
    - tree: FAILURE # the tree never ends, so no run succeeds
  measure: [path_length_m]
"""


def test_runs_are_evaluated_the_worst_is_played_and_a_repair_is_compared(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.new_from("laser_bump_and_go")
    page = studio.page
    page.get_by_role("tab", name="Evaluate", exact=True).click()
    panel = studio.at("evaluate")
    panel.get_by_role("button", name="YAML").click()
    studio.replace_code(STRICT)
    studio.saved()
    panel.get_by_role("button", name="Evaluate", exact=True).click()
    cell = panel.get_by_test_id("evaluation-cell")
    expect(panel.get_by_test_id("evaluation-rate")).to_contain_text("0 %", timeout=SLOW_MS)
    expect(panel.get_by_role("button", name="Compare…")).to_be_visible(timeout=SLOW_MS)
    expect(panel.get_by_text("6 of 6 runs")).to_be_visible()
    grid = panel.get_by_role("slider", name="Runs by seed")
    grid.press("Home")
    grid.press("ArrowRight")
    expect(cell).to_contain_text(re.compile("^Seed 1: failure after 3 s"))
    grid.press("Enter")
    page.wait_for_url(re.compile(r"\?run=[0-9a-f-]{36}&t=3\.\d+"), timeout=SLOW_MS)
    studio.picture("evaluate-played")
    panel.get_by_role("button", name="Compare…").click()
    panel.get_by_role("button", name="Compare", exact=True).click()
    comparison = panel.get_by_test_id("evaluation-comparison")
    expect(comparison).to_contain_text("No difference between the revisions", timeout=SLOW_MS)
    studio.picture("evaluate-compared")
