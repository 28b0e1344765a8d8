"""The frame of the editor: its panels, its state after a reload, settings, and the command palette."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_focus_to_show
from tests.e2e.canvas_by_hand import block, middle, place
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]


def test_the_frame_is_as_it_was_left(studio: Studio) -> None:
    """Panels, theme, language and hints survive a reload; *Put the panels back* resets the layout."""
    page = studio.page
    expect_focus_to_show(page, "start page", 12)
    studio.new_from("laser_bump_and_go")
    expect_focus_to_show(page, "frame", 40)
    hints_are_closed(studio)
    explorer = page.get_by_role("tab", name="Explorer", exact=True)
    start = width_of_files(studio)
    x, y = edge_of_files(studio)
    pull(studio, (x, y), (x + 120, y))
    wait_until(lambda: width_of_files(studio) > start + 80, "the panel is wider")
    outline = page.get_by_role("tab", name="Outline", exact=True)
    pull(studio, middle(outline), middle(page.get_by_role("tab", name="Problems")))
    wait_until(lambda: middle(outline)[1] > 450, "the panel is among those below")
    studio.at("theme-toggle").click()
    theme = page.locator("html").get_attribute("data-mantine-color-scheme")
    page.get_by_role("button", name="More", exact=True).click()
    studio.menu("More").get_by_role("menuitem", name="Español").click()
    expect(page.get_by_role("tab", name="Esquema", exact=True)).to_be_visible()
    wide = width_of_files(studio)
    page.wait_for_timeout(400)  # the layout is stored a moment after the last change

    page.reload()
    expect(page.get_by_role("tab", name="Esquema", exact=True)).to_be_visible()
    expect(page.locator("html")).to_have_attribute("lang", "es")
    expect(page.locator("html")).to_have_attribute("data-mantine-color-scheme", str(theme))
    wait_until(lambda: abs(width_of_files(studio) - wide) < 3, "the width is kept")
    assert middle(page.get_by_role("tab", name="Esquema", exact=True))[1] > 450
    expect(studio.at("hint")).to_have_count(0)

    studio.command("inglés")
    expect(explorer).to_be_visible()
    page.get_by_role("button", name="More", exact=True).click()
    studio.menu("More").get_by_role("menuitem", name="Put the panels back").click()
    wait_until(lambda: abs(width_of_files(studio) - start) < 3, "the panels are as at first")
    wait_until(lambda: middle(outline)[1] < 450, "each is at its first place")
    expect(studio.at("canvas")).to_be_visible()
    settings_are_kept(studio)


def settings_are_kept(studio: Studio) -> None:
    """Name and rates by the dialogue; an invalid name is refused while it is typed."""
    page = studio.page
    page.keyboard.press("Control+Comma")
    form = studio.at("settings")
    name = form.get_by_role("textbox", name="Name")
    for wrong, reason in (("", "needs a name"), ("a/b", "not a path"), ("x" * 101, "at most 100")):
        name.fill(wrong)
        expect(form).to_contain_text(reason)
        expect(form.get_by_role("button", name="Save")).to_be_disabled()
    name.fill("Robot 🤖")
    form.get_by_role("radio", name="Begin again").check()
    studio.picture("settings")
    form.get_by_role("button", name="Save").click()
    expect(page.locator("header").first).to_contain_text("Robot 🤖")
    studio.saved()
    page.reload()
    expect(page.locator("header").first).to_contain_text("Robot 🤖")
    page.keyboard.press("Control+Comma")
    expect(form.get_by_role("radio", name="Begin again")).to_be_checked()
    page.keyboard.press("Escape")


def pull(studio: Studio, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Presses at a point, moves to another in steps, and releases."""
    mouse = studio.page.mouse
    mouse.move(*start)
    mouse.down()
    mouse.move(start[0] + 12, start[1] + 4, steps=3)
    mouse.move(*end, steps=8)
    mouse.move(end[0] + 3, end[1], steps=3)
    mouse.up()


def edge_of_files(studio: Studio) -> tuple[float, float]:
    """Returns the middle of the border between the panels at the left and the tree."""
    boxes = [place(each) for each in studio.page.locator(".flexlayout__splitter").all()]
    x, y, width, height = min(box for box in boxes if box[3] > 300)
    return x + width / 2, y + height / 3


def hints_are_closed(studio: Studio) -> None:
    for hint in ("build", "run", "find"):
        expect(studio.at("hint")).to_have_attribute("data-hint", hint)
        studio.page.get_by_role("button", name="Close this hint permanently").click()
    expect(studio.at("hint")).to_have_count(0)


def width_of_files(studio: Studio) -> float:
    return place(studio.page.locator(".flexlayout__tabset").first)[2]


def test_the_palette_knows_every_button(studio: Studio) -> None:
    """Every command of a button, a menu or a tool is in the palette, with the same words."""
    page = studio.page
    studio.new_from("laser_bump_and_go")
    block(studio, "ReactiveFallback").click()
    wanted = labels_of(page.locator("header").first.get_by_role("button"))
    wanted |= labels_of(page.get_by_role("toolbar", name="View of the tree").get_by_role("button"))
    for menu in ("More", "More ways to run"):
        page.get_by_role("button", name=menu, exact=True).click()
        expect(studio.menu(menu)).to_be_visible()
        wanted |= labels_of(studio.menu(menu).get_by_role("menuitem"))
        page.keyboard.press("Escape")
    page.keyboard.press("Control+k")
    options = studio.at("command-palette").get_by_role("option")
    expect(options.first).to_be_visible()
    known = {text.lower() for text in options.all_inner_texts()}
    shortcuts = {line.split("\n")[0]: line for line in known}
    missing = {
        label for label in wanted - NO_COMMANDS if not any(label.lower() in command for command in known)
    }
    assert not missing, f"not in the palette: {sorted(missing)}"
    assert "f2" in shortcuts["rename the block"]
    assert "ctrl+c" in shortcuts["copy"]


# Buttons that open menus, the palette itself, and the save state, which is a button as well.
NO_COMMANDS = {"More", "More ways to run", "All commands…", "Saved"}


def labels_of(buttons: Locator) -> set[str]:
    """Returns the labels of buttons and menu items, without their shortcuts and values."""
    names = buttons.evaluate_all(
        "all => all.map(each => each.getAttribute('aria-label') ||"
        " each.querySelector('.mantine-Menu-itemLabel')?.textContent || each.textContent)"
    )
    return {re.sub(r" \([^)]*\)$|^\d+% · |: .*$", "", str(name)) for name in names}


# Keys of the shortcut page that no other walk presses, and what is to be seen then.
SHOWS = {
    "Control+Backquote": "[data-testid=console]",
    "Control+Shift+KeyM": "[data-testid=problems]",
    "Control+Shift+KeyH": "[data-testid^=revision-], [data-testid=revisions]",
    "Control+Shift+KeyF": "[data-testid=search-text]",
}


# Keys of the canvas, the second keys of Redo, and those of the palette itself.
BESIDE_THE_PALETTE = {"← ↑ → ↓", "Ctrl+← ↑ → ↓", "Shift+Del", "Home", "Shift+F10", "Ctrl+Shift+Z", "Ctrl+K"}


def test_the_page_of_shortcuts_tells_the_truth(studio: Studio) -> None:
    """Each key means one thing, the page is the palette's list, and the keys do what it says."""
    keys = studio.page.keyboard
    studio.new_from("laser_bump_and_go")
    keys.press("Control+Slash")
    page = studio.at("shortcuts")
    expect(page.get_by_role("heading")).to_have_count(7)
    rows = [row.split("\t") for row in page.get_by_role("row").all_inner_texts()]
    # A debugger's keys mean something else while it holds the tree, and Escape while runs are compared.
    by_keys: dict[tuple[str, bool], set[str]] = {}
    for label, shown in rows:
        by_keys.setdefault((shown, label.startswith("Held:")), set()).add(label)
    assert {keys for keys, labels in by_keys.items() if len(labels) > 1} <= {
        ("Space", False),
        ("Esc", False),
    }
    studio.picture("shortcuts")
    keys.press("Escape")
    keys.press("Control+k")
    known = set(studio.at("command-palette").get_by_role("option").all_inner_texts())
    for label, shown in rows:
        is_known = any(label in text and shown in text for text in known)
        assert is_known or shown in BESIDE_THE_PALETTE, (label, shown)
    keys.press("Escape")
    for shortcut, target in SHOWS.items():
        keys.press(shortcut)
        expect(studio.page.locator(target).first).to_be_visible()
        keys.press("Alt+t")
