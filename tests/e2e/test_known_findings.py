"""The findings of what is known without running, by hand: the path of the reason, fixes, silence and undo."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.test_hands_projects import drop
from tests.e2e.test_problems import show_problems

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]

TREE = b"""<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence name="all">
  <ForceSuccess name="sure"><SubTree ID="Ready"/></ForceSuccess>
  <Repeat num_cycles="-1" name="again"><Script code="x := 1"/></Repeat>
</Sequence></BehaviorTree>
<BehaviorTree ID="Ready"><Sequence name="ready"><Script code="y := 2"/></Sequence></BehaviorTree>
</root>"""
REASON = "it fails as soon as the camera is there"


def shown_tree(studio: Studio, tree: str) -> Locator:
    return studio.page.locator(f'[data-testid="canvas"][data-tree="{tree}"]')


def test_a_finding_is_followed_fixed_silenced_and_reported_again(studio: Studio) -> None:
    page = studio.page
    drop(studio, "known.xml", TREE)
    page.get_by_role("dialog").get_by_role("button", name=re.compile("^(Close|Done)$")).first.click()
    problems = show_problems(studio)
    sure = problems.get_by_role("listitem").filter(has=page.locator('[data-code="BT0119"]'))
    expect(sure).to_contain_text("changes nothing")
    for scheme in ("light", "dark"):
        expect_accessible(studio, scheme)
        studio.picture(f"known-findings-{scheme}")

    sure.get_by_role("list", name="Reason").get_by_role("button").last.click()
    expect(shown_tree(studio, "Ready")).to_be_visible()
    sure.get_by_role("list", name="Reason").get_by_role("button").first.click()
    expect(shown_tree(studio, "Main")).to_be_visible()

    spin = problems.get_by_role("listitem").filter(has=page.locator('[data-code="BT0120"]'))
    spin.get_by_test_id("fix-insert-delay").click()
    expect(page.locator("[data-type=Delay]")).to_be_visible()
    expect(spin).to_have_count(0)
    page.get_by_role("button", name="Undo", exact=True).first.click()
    expect(page.locator("[data-type=Delay]")).to_have_count(0)

    sure.get_by_role("button", name="More about BT0119").click()
    page.get_by_role("menuitem", name="Silence here…").click()
    dialog = page.get_by_role("dialog", name="Silence BT0119 at this block")
    expect(dialog).to_be_visible()
    expect_accessible(studio, "dark")
    studio.picture("known-silence")
    page.keyboard.type(REASON)
    page.keyboard.press("Tab")
    dialog.get_by_role("button", name="Silence", exact=True).click()
    expect(sure).to_have_count(0)
    block = page.locator("[data-type=ForceSuccess]")
    expect(block.get_by_test_id("silenced")).to_have_attribute("title", f"BT0119: {REASON}")
    studio.saved()
    block.click()
    inspector = studio.at("inspector")
    expect(inspector).to_contain_text(REASON)
    studio.picture("known-silenced")
    page.set_viewport_size({"width": 390, "height": 844})
    studio.picture("known-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    inspector.get_by_test_id("unsilence-BT0119").click()
    expect(sure).to_be_visible()
