"""Ports that are texts, lists and outputs, typed key by key: a brace makes a value a key on the way."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.canvas_by_hand import block, children, rest, wrap
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]


def test_ports_are_typed_key_by_key(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    rest(block(studio, "Turn"))
    whole = children(studio)
    lists_and_outputs(studio, whole)
    texts(studio, whole)
    the_tree_of_a_subtree(studio)


def lists_and_outputs(studio: Studio, whole: list[str]) -> None:
    page, keys = studio.page, studio.page.keyboard
    block(studio, "Turn").click()
    wrap(studio, "LoopString")
    loop, queue, value = block(studio, "LoopString"), studio.at("port-queue"), studio.at("port-value")
    expect(value).to_have_attribute("placeholder", "{value}")
    queue.click()
    keys.type("{names}")  # the first brace makes the value a key; the caret stays
    expect(loop).to_contain_text("{names}")
    keys.press("Control+a")
    keys.type("left;right")
    expect(queue).to_have_value("left;right")
    value.click()
    keys.type("side")  # a fixed value cannot be written
    expect(loop).to_have_attribute("data-problem", "error")
    expect(studio.at("inspector")).to_contain_text("is written by the node")
    keys.press("Control+a")
    keys.type("{side}")
    expect(value).to_have_value("{side}")
    keys.press("Escape")
    expect(loop).not_to_have_attribute("data-problem", "error")
    studio.at("port-if_empty").click()
    page.get_by_role("option", name="FAILURE").click()
    expect(loop).to_contain_text("FAILURE")
    studio.picture("inspector-loop")
    loop.click()
    keys.press("Shift+Delete")
    wait_until(lambda: children(studio) == whole, "the tree is as before")


def texts(studio: Studio, whole: list[str]) -> None:
    """Any text stays as it stands."""
    keys = studio.page.keyboard
    block(studio, "Forward").click()
    keys.press("Control+Enter")
    studio.writing()
    keys.type("SetBlackboard")
    keys.press("Enter")
    told = block(studio, "SetBlackboard")
    studio.at("port-value").click()
    keys.type("a b, c")
    studio.at("port-output_key").click()
    keys.type("{note}")
    keys.press("Escape")
    expect(told).to_contain_text("a b, c")
    expect(told).not_to_have_attribute("data-problem", "error")
    told.click()
    keys.press("Delete")
    wait_until(lambda: children(studio) == whole, "the tree is as before")


def the_tree_of_a_subtree(studio: Studio) -> None:
    """Chosen from a list, without the tree itself."""
    page = studio.page
    block(studio, "ReactiveFallback").click(button="right")
    page.get_by_role("menuitem", name="Extract").click()
    call = block(studio, "SubTree")
    call.click()
    studio.command("new tree")
    page.get_by_role("dialog").get_by_role("textbox").fill("Dock")
    page.keyboard.press("Enter")
    studio.command("open tree maintree")
    call.click()
    studio.at("inspector").get_by_role("combobox", name="Tree").click()
    expect(page.get_by_role("option", name="MainTree")).to_have_count(0)
    page.get_by_role("option", name="Dock", exact=True).click()
    expect(call).to_contain_text("Dock")
    studio.at("undo").click()
    expect(call).not_to_contain_text("Dock")
    studio.saved()
