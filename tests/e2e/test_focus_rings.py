"""The ring of the keyboard focus is whole wherever the focus goes."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]
# A ring that is cut by less cannot be seen.
LEAST_PX = 0.9
CUT_RINGS = """(least) => {
  const most = (outer, inner) => Math.max(
    outer.left - inner.left, outer.top - inner.top, inner.right - outer.right, inner.bottom - outer.bottom);
  const grown = (r, by) => new DOMRect(r.x - by, r.y - by, r.width + 2 * by, r.height + 2 * by);
  const isCut = (element) => {
    const style = getComputedStyle(element);
    const box = element.getBoundingClientRect();
    const ring = grown(box, parseFloat(style.outlineWidth) + parseFloat(style.outlineOffset));
    for (let above = element.parentElement; above; above = above.parentElement) {
      const { overflowX, overflowY } = getComputedStyle(above);
      if (!/hidden|auto|scroll|clip/.test(overflowX + overflowY)) continue;
      const outer = above.getBoundingClientRect();
      if (most(outer, box) < least && most(outer, ring) > least) return true;
    }
    return false;
  };
  const kinds = 'button:enabled, a[href], input, select, textarea, [tabindex="0"]';
  const found = [...document.querySelectorAll(kinds)];
  return found.filter((element) => {
    if (!element.checkVisibility() || element.closest('.react-flow__attribution')) return false;
    element.focus({ focusVisible: true });
    const hasRing = getComputedStyle(element).outlineStyle !== 'none';
    return document.activeElement === element && hasRing && isCut(element);
  }).map((element) => element.ariaLabel ?? element.textContent.slice(0, 40));
}"""


def test_no_panel_or_bar_cuts_the_ring(studio_without_views: Studio) -> None:
    studio = studio_without_views
    studio.page.set_viewport_size({"width": 1280, "height": 720})
    studio.new_from("laser_bump_and_go")
    studio.run()
    # These two are hidden until they are used.
    studio.page.keyboard.press("Control+Alt+KeyB")
    studio.page.keyboard.press("Control+Alt+KeyP")
    for panel in ("Console", "Problems", "Tests", "Evaluate", "Timeline", "Topics", "Breakpoints", "Profile"):
        studio.page.get_by_role("tab", name=panel, exact=True).first.click()
        cut: list[str] = studio.page.evaluate(CUT_RINGS, LEAST_PX)
        assert cut == [], f"{panel}: {json.dumps(cut)}"
