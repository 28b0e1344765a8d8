"""Files by hand: help with Python, other kinds of text, names, ports that follow, drafts; and the library."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.canvas_by_hand import block
from tests.e2e.studio import Studio
from tests.e2e.test_code import expect_help, line, spot

if TYPE_CHECKING:
    from playwright.sync_api import Locator

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

HELPED = """from Turn import Turn


def limited(speed: float, most: float = 1.0) -> float:
    return min(speed, most)


class Forward(Turn):
    pass
"""
OPEN = """import py_trees


class Old(py_trees.behaviour.Behaviour):
    def update(self):
        return py_trees.common.Status.SUCCESS
"""
PIECE = '<Sequence><AlwaysSuccess/><Sleep msec="50"/></Sequence>'
CHANGES = re.compile(r".*/changes$")
TEMPLATES = {"Go": "speed", "Drive": "seconds", "Sees": "limit", "Ask": "service", "Reach": "x"}


def editor(studio: Studio, path: str) -> Locator:
    return studio.page.locator(f'[data-testid="code-editor"][data-path="{path}"]').locator(".cm-content")


def open_editor(studio: Studio, path: str) -> None:
    studio.at(f"file-{path}").click()
    editor(studio, path).click()


def replace(studio: Studio, path: str, text: str) -> None:
    """Opens a file and replaces its text by typing."""
    open_editor(studio, path)
    studio.page.keyboard.press("Control+a")
    studio.page.keyboard.insert_text(text)


def stored(studio: Studio, path: str) -> str | None:
    """Returns the text of a file on the server; None where it has none."""
    project = studio.page.url.rstrip("/").split("/")[-1]
    detail = studio.page.request.get(f"{studio.server.origin}/api/v1/projects/{project}").json()
    return next((str(file["content"]) for file in detail["files"] if file["path"] == path), None)


def tab(studio: Studio, name: str) -> Locator:
    return studio.page.get_by_role("tab", name=name, exact=True)


def new(studio: Studio, kind: str, name: str) -> None:
    """Creates a file by the explorer's dialogue."""
    studio.at(f"new-{kind}").first.click()
    studio.page.get_by_role("dialog").get_by_role("textbox").fill(name)
    studio.at("file-dialog-ok").click()


def rename(studio: Studio, shown: str, name: str) -> None:
    """Renames a file by the explorer's menu."""
    studio.page.get_by_role("button", name=f"More for {shown}", exact=True).click()
    studio.menu(f"More for {shown}").get_by_role("menuitem", name="Rename").click()
    studio.page.get_by_role("dialog").get_by_role("textbox").fill(name)
    studio.at("file-dialog-ok").click()


@pytest.mark.long_walk
def test_files_by_hand(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    signatures_and_references(studio)
    letters_have_a_size(studio)
    drafts_survive(studio)
    other_kinds_of_text(studio)
    names_that_cannot_be(studio)
    tabs_follow_their_files(studio)
    templates_and_ports_that_follow(studio)
    ports_of_an_action_that_declares_none(studio)
    all_of_it_in_spanish(studio)


def signatures_and_references(studio: Studio) -> None:
    page, keys = studio.page, studio.page.keyboard
    studio.open_file("actions/Forward.py")
    expect_help(studio)
    replace(studio, "actions/Forward.py", HELPED)
    keys.press("Control+End")
    keys.type("\nslow = limited(")
    signature = page.locator(".cm-lsp-signature-tooltip")
    expect(signature).to_contain_text("speed: float")
    expect(signature.locator(".cm-lsp-active-parameter")).to_contain_text("speed")
    keys.type("0.5, ")
    expect(signature.locator(".cm-lsp-active-parameter")).to_contain_text("most")
    studio.picture("code-signature-light")
    keys.press("Escape")
    keys.press("Escape")

    page.mouse.click(*spot(studio, "class Forward(Turn)", "Turn"))
    keys.press("Shift+F12")
    found = page.get_by_test_id("references").filter(visible=True)
    expect(found).to_contain_text("3 places in 2 files")
    expect(found.get_by_role("group", name="actions/Forward.py").get_by_role("option")).to_have_count(2)
    expect(found.get_by_role("listbox")).to_be_focused()
    studio.picture("code-references-light")
    keys.press("End")
    keys.press("Enter")
    expect(editor(studio, "actions/Turn.py")).to_be_focused()
    expect(tab(studio, "Turn.py")).to_have_attribute("aria-selected", "true")
    expect(found).to_be_visible()
    keys.press("Escape")
    expect(found).to_have_count(0)


def letters_have_a_size(studio: Studio) -> None:
    scroller = studio.page.locator('[data-path="actions/Turn.py"] .cm-scroller')
    expect(scroller).to_have_css("font-size", "13px")
    for _ in range(3):
        studio.page.keyboard.press("Control+=")
    studio.page.keyboard.press("Control+-")
    expect(scroller).to_have_css("font-size", "15px")
    studio.saved()
    studio.page.reload()
    expect(scroller).to_have_css("font-size", "15px")
    editor(studio, "actions/Turn.py").click()
    studio.page.keyboard.press("Control+0")
    expect(scroller).to_have_css("font-size", "13px")


def drafts_survive(studio: Studio) -> None:
    """Unsaved text survives a crash of the page, with a notice, and is saved when the server is back."""
    context = studio.page.context
    address = studio.page.url
    context.route(CHANGES, lambda route: route.abort("internetdisconnected"))
    editor(studio, "actions/Turn.py").click()
    studio.page.keyboard.press("Control+End")
    studio.page.keyboard.type("\n# not saved yet")
    expect(studio.at("save-state")).to_have_attribute("data-state", "failed")
    crashed = studio.page
    studio.page = context.new_page()
    crashed.close(run_before_unload=False)
    studio.page.on("console", studio._note)
    studio.page.goto(address)
    expect(studio.page.get_by_text("Edits to one file that had not been saved are back.")).to_be_visible()
    expect(line(studio, "# not saved yet")).to_be_visible()
    assert "# not saved yet" not in (stored(studio, "actions/Turn.py") or "")
    context.unroute(CHANGES)
    studio.saved()
    assert (stored(studio, "actions/Turn.py") or "").endswith("\n# not saved yet")


def other_kinds_of_text(studio: Studio) -> None:
    page = studio.page
    for path, bad, word, good in (
        ("assets/map.json", '{"scale": oh}', "oh", '{"scale": 2}'),
        ("assets/sizes.yaml", "wide: 1\nwide: 2\n", "wide", "# in m\nwide: 1\nlong: [1, 2]\n"),
        ("assets/part.xml", "<a>\n<b/>\n</c>", "", "<a>\n<b/>\n</a>"),
    ):
        new(studio, "file", path)
        replace(studio, path, bad)
        shown = page.locator(f'[data-path="{path}"]')
        expect(shown.locator(".cm-lintRange-error").last).to_contain_text(word)
        expect(shown.locator(".cm-lint-marker-error")).to_be_visible()
        page.keyboard.press("Control+a")
        page.keyboard.insert_text(good)
        expect(shown.locator(".cm-lintRange-error")).to_have_count(0)
        expect(shown.locator(".cm-line span[class]").first).to_be_visible()
        studio.saved()
        assert stored(studio, path) == good
    new(studio, "file", "notes.md")
    replace(studio, "notes.md", "# Why\n\n*because* `it` is\n")
    expect(page.locator('[data-path="notes.md"] .cm-line').first.locator("span[class]").first).to_be_visible()

    # A large file and an empty one: neither is lost.
    page.keyboard.press("Control+End")
    editor(studio, "notes.md").evaluate(
        """(element, line) => {
            const clipboardData = new DataTransfer();
            clipboardData.setData('text/plain', line.repeat(90_000));
            element.dispatchEvent(new ClipboardEvent('paste', { clipboardData, bubbles: true }));
        }""",
        "- a line of a long list\n",
    )
    expect(studio.at("save-state")).not_to_have_attribute("data-state", "saved")
    studio.saved()
    assert len(stored(studio, "notes.md") or "") > 2_000_000
    page.keyboard.press("Control+a")
    page.keyboard.press("Delete")
    studio.saved()
    assert stored(studio, "notes.md") == ""
    page.keyboard.press("Control+z")
    expect(line(studio, "- a line of a long list")).to_be_visible()
    replace(studio, "notes.md", "# Short\n")
    studio.saved()


def names_that_cannot_be(studio: Studio) -> None:
    dialogue = studio.page.get_by_role("dialog")
    for kind, name, problem in (
        ("file", "../secret.md", "A path inside the project"),
        ("file", "my notes.md", "A path inside the project"),
        ("file", "notes.MD", "This name is already in use"),
        ("action", "lambda", "no Python keyword"),
        ("action", "Go on", "Letters, digits and _ only"),
        ("action", "Größe", "Letters, digits and _ only"),
        ("action", "Turn", "This name is already in use"),
    ):
        studio.at(f"new-{kind}").first.click()
        dialogue.get_by_role("textbox").fill(name)
        studio.at("file-dialog-ok").click()
        expect(dialogue).to_contain_text(problem)
        studio.page.keyboard.press("Escape")
        expect(dialogue).to_have_count(0)
    open_editor(studio, "actions/Turn.py")
    studio.page.mouse.click(*spot(studio, "class Turn", "Turn"))
    studio.page.keyboard.press("F2")
    dialogue.get_by_role("textbox").fill("class")
    studio.page.keyboard.press("Enter")
    expect(dialogue).to_contain_text("“class” cannot be a name in Python.")
    studio.page.keyboard.press("Escape")
    expect(dialogue).to_have_count(0)
    expect(line(studio, "class Turn(")).to_be_visible()


def tabs_follow_their_files(studio: Studio) -> None:
    """The tab of a renamed file keeps its undo steps; undo on the canvas reverts an action's name."""
    keys = studio.page.keyboard
    open_editor(studio, "notes.md")
    keys.press("Control+End")
    keys.type("more")
    rename(studio, "notes.md", "docs/notes.md")
    expect(studio.at("file-docs/notes.md")).to_be_visible()
    expect(editor(studio, "docs/notes.md")).to_be_focused()
    keys.type(" of it")
    expect(line(studio, "more of it")).to_be_visible()
    keys.press("Control+z")
    keys.press("Control+z")
    expect(line(studio, "more")).to_have_count(0)
    expect(tab(studio, "notes.md")).to_have_count(1)
    rename(studio, "Turn.py", "Spin")
    expect(tab(studio, "Turn.py")).to_have_count(0)
    expect(tab(studio, "Spin.py")).to_have_attribute("aria-selected", "true")
    expect(line(studio, "class Spin(")).to_be_visible()
    expect(studio.page.get_by_text("is not in this project any more")).to_have_count(0)
    studio.saved()
    assert "from Spin import Spin" in (stored(studio, "actions/Forward.py") or "")
    rename(studio, "MainTree", "Patrol")
    expect(tab(studio, "MainTree")).to_have_count(0)
    expect(tab(studio, "Patrol")).to_have_count(1)
    expect(block(studio, "Spin")).to_be_visible()
    studio.saved()


def templates_and_ports_that_follow(studio: Studio) -> None:
    page = studio.page
    for at, (name, port) in enumerate(TEMPLATES.items()):
        studio.at("new-action").first.click()
        page.get_by_role("dialog").get_by_role("textbox").fill(name)
        page.get_by_role("dialog").get_by_role("radio").nth(at).click()
        studio.at("file-dialog-ok").click()
        expect(line(studio, f"class {name}(")).to_be_visible()
        studio.saved()
        tab(studio, "Patrol").click()
        block(studio, "ReactiveSequence").click()
        studio.at(f"palette-{name}").click()
        expect(studio.at("inspector")).to_have_attribute("aria-label", name)
        expect(studio.at(f"port-{port}")).to_be_visible()
    source = stored(studio, "actions/Go.py") or ""
    declared = '"speed": Port(float, default=0.2'
    assert declared in source
    replace(studio, "actions/Go.py", source.replace(declared, '"pace": Port(int, default=3'))
    studio.saved()
    tab(studio, "Patrol").click()
    block(studio, "Go").click()
    expect(studio.at("port-pace")).to_have_attribute("placeholder", "Default: 3")
    expect(studio.at("port-speed")).to_have_count(0)


def ports_of_an_action_that_declares_none(studio: Studio) -> None:
    page, keys = studio.page, studio.page.keyboard
    new(studio, "action", "Old")
    replace(studio, "actions/Old.py", OPEN)
    studio.saved()
    tab(studio, "Patrol").click()
    block(studio, "ReactiveSequence").click()
    studio.at("palette-Old").click()
    block(studio, "Old").click()
    keys.press("Control+d")
    expect(block(studio, "Old")).to_have_count(2)
    inspector = studio.at("inspector")

    def named(button: str, name: str) -> None:
        inspector.get_by_role("button", name=button, exact=True).click()
        inspector.get_by_label("Name of the port").fill(name)

    named("Add port", "_skipIf")
    expect(inspector).to_contain_text("A letter first")
    inspector.get_by_label("Name of the port").fill("goal")
    keys.press("Enter")
    for old in block(studio, "Old").all():
        expect(old).to_contain_text("goal")
    named("Rename port goal", "aim")
    keys.press("Enter")
    for old in block(studio, "Old").all():
        expect(old).to_contain_text("aim")
    studio.picture("ports-of-open-action-light")
    inspector.get_by_role("button", name="Remove port aim").click()
    for old in block(studio, "Old").all():
        expect(old).not_to_contain_text("aim")
    studio.at("undo").click()
    for old in block(studio, "Old").all():
        expect(old).to_contain_text("aim")
    studio.saved()
    expect_accessible(studio, "light")
    assert page.get_by_text("undefined").count() == 0


def all_of_it_in_spanish(studio: Studio) -> None:
    page = studio.page
    page.get_by_role("button", name="More", exact=True).click()
    studio.menu("More").get_by_role("menuitem", name="Español").click()
    open_editor(studio, "actions/Spin.py")
    expect(page.locator(".flexlayout__tab_button_trailing").first).to_have_attribute("title", "Cerrar")
    expect(page.locator(".flexlayout__tab_button_trailing[title=Close]")).to_have_count(0)
    page.keyboard.press("Control+f")
    expect(page.locator(".cm-search").get_by_placeholder("Buscar")).to_be_focused()
    page.keyboard.press("Escape")


def test_pieces_travel(studio: Studio) -> None:
    """Blocks between canvas and text, and a behaviour that another project reuses and updates."""
    studio.new_from("laser_bump_and_go")
    a_piece_is_text(studio)
    other = Studio(studio.page.context.new_page(), studio.server)
    other.page.goto(studio.server.origin)
    other.at("new-from-empty").click()
    name = studio.page.title().removesuffix(" — BT Studio")
    a_tree_is_reused(other, name)
    studio.set_port("n6", "lin_speed", "0.123")
    an_update_is_shown_before_it_is_taken(other, name)
    assert other.complaints == []


def a_piece_is_text(studio: Studio) -> None:
    keys = studio.page.keyboard
    new(studio, "file", "assets/piece.xml")
    replace(studio, "assets/piece.xml", PIECE)
    keys.press("Control+a")
    keys.press("Control+c")
    tab(studio, "MainTree").click()
    block(studio, "ReactiveSequence").click()
    keys.press("Control+v")
    expect(block(studio, "Sleep")).to_be_visible()
    studio.at("undo").click()
    expect(block(studio, "Sleep")).to_have_count(0)
    block(studio, "Inverter").click()
    keys.press("Control+c")
    open_editor(studio, "assets/piece.xml")
    keys.press("Control+a")
    keys.press("Control+v")
    expect(line(studio, "<Inverter")).to_be_visible()
    expect(line(studio, "<CheckObstacle")).to_be_visible()
    studio.saved()
    tab(studio, "MainTree").click()


def choose_source(studio: Studio, name: str) -> None:
    studio.at("library-source").click()
    studio.at("library-source").fill(name[:6])
    studio.page.get_by_role("option", name=name, exact=True).click()


def a_tree_is_reused(studio: Studio, source: str) -> None:
    studio.at("palette-Sequence").click()
    block(studio, "Sequence").click()
    tab(studio, "Library").click()
    choose_source(studio, source)
    row = studio.at("behaviour-MainTree")
    row.get_by_role("button", name="MainTree", exact=True).click()
    expect(row.locator("svg rect, svg path").first).to_be_visible()
    expect(row).to_contain_text("actions/Turn.py")
    expect(row).to_contain_text(f"As it is now in {source}")
    studio.at("insert-MainTree").click()
    studio.at("take-arrivals").click()
    expect(studio.at("file-trees/MainTree2.json")).to_be_visible()
    expect(studio.at("file-actions/CheckObstacle.py")).to_be_visible()
    expect(block(studio, "SubTree")).to_be_visible()
    expect(studio.at("update-MainTree")).to_have_count(0)
    studio.saved()


def an_update_is_shown_before_it_is_taken(studio: Studio, source: str) -> None:
    studio.at("theme-toggle").click()
    choose_source(studio, "Built-in and offered")
    choose_source(studio, source)
    studio.at("update-MainTree").click()
    difference = studio.at("difference-trees/MainTree2.json")
    expect(difference.locator(".cm-merge-b")).to_contain_text("0.123")
    expect(difference.locator(".cm-merge-a")).not_to_contain_text("0.123")
    expect_accessible(studio, "dark")
    studio.picture("library-update-dark")
    assert "0.123" not in (stored(studio, "trees/MainTree2.json") or "")
    studio.at("confirm-update").click()
    expect(studio.at("update-MainTree")).to_have_count(0)
    studio.saved()
    assert "0.123" in (stored(studio, "trees/MainTree2.json") or "")
