"""The start page by hand: every way to add projects and to organize them, and no way to lose one."""

from __future__ import annotations

import base64
import io
import re
import zipfile
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_accessible, expect_no_findings
from tests.fakes.react_diagrams import chain

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

BTCPP = b"""<root BTCPP_format="4" main_tree_to_execute="Patrol">
  <BehaviorTree ID="Patrol"><Sequence><AlwaysSuccess/><Sleep msec="10"/></Sequence></BehaviorTree>
</root>"""
UNKNOWN = b"""<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main"><Sequence>
    <Grab object="cup"/><Twice><AlwaysSuccess/></Twice><Race><AlwaysSuccess/></Race><SubTree ID="Elsewhere"/>
  </Sequence></BehaviorTree>
  <TreeNodesModel><Decorator ID="Twice"/><Control ID="Race"/></TreeNodesModel>
</root>"""
ACTION = b"""import py_trees


class Wave(py_trees.behaviour.Behaviour):
    def update(self):
        return py_trees.common.Status.SUCCESS
"""


def zipped(files: Mapping[str, bytes]) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for path, data in files.items():
            archive.writestr(path, data)
    return buffer.getvalue()


def cards(studio: Studio) -> Locator:
    return studio.at("project-card")


def card(studio: Studio, name: str) -> Locator:
    return cards(studio).filter(has=studio.page.get_by_text(name, exact=True))


def choose(studio: Studio, name: str, item: str) -> None:
    """Opens a card's menu and clicks an item."""
    card(studio, name).get_by_role("button", name=f"More for {name}", exact=True).click()
    # The menu of another card may still fade away.
    studio.menu(f"More for {name}").get_by_role("menuitem", name=item).click()


def drop(studio: Studio, filename: str, data: bytes) -> None:
    """Drops a file onto the page, as from the desktop."""
    transfer = studio.page.evaluate_handle(
        "([name, data]) => { const transfer = new DataTransfer();"
        " const bytes = Uint8Array.from(atob(data), c => c.charCodeAt(0));"
        " transfer.items.add(new File([bytes], name)); return transfer }",
        [filename, base64.b64encode(data).decode()],
    )
    studio.page.dispatch_event("body", "dragover", {"dataTransfer": transfer})
    expect(studio.page.get_by_text("Drop a project zip")).to_be_visible()
    studio.page.dispatch_event("body", "drop", {"dataTransfer": transfer})


def report(studio: Studio, filename: str) -> None:
    """Reads what came in with an import, and closes it."""
    dialog = studio.page.get_by_role("dialog", name=f"Imported from {filename}")
    expect(dialog.get_by_test_id("import-report")).to_contain_text("1 tree")
    dialog.get_by_role("button", name="Done").click()
    expect(dialog).to_have_count(0)


def what_is_missing_is_said(studio: Studio) -> None:
    """A tree of unknown nodes: stubs of each kind, a missing subtree, and the way to the first of them."""
    drop(studio, "unknown.xml", UNKNOWN)
    dialog = studio.page.get_by_role("dialog", name="Imported from unknown.xml")
    for words in ("Grab action", "Twice decorator", "Race control node", "Elsewhere"):
        expect(dialog).to_contain_text(words)
    for scheme in ("dark", "light"):
        studio.page.evaluate(
            "s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme
        )
        expect_no_findings(studio.page, f"import report, {scheme}")
        studio.picture(f"import-report-{scheme}")
    dialog.get_by_role("button", name="Open the first problem").click()
    expect(dialog).to_have_count(0)
    expect(studio.page.locator("[data-type=SubTree].selected, .selected [data-type=SubTree]")).to_have_count(
        1
    )
    home(studio)


def home(studio: Studio) -> None:
    studio.page.get_by_role("link", name="All projects").click()
    expect(studio.at("projects")).to_be_visible()


def make(studio: Studio, names: list[str]) -> None:
    """Creates empty projects as fast as the server does."""
    studio.page.evaluate(
        "async names => { for (const name of names) await fetch('/api/v1/projects', {method: 'POST',"
        " headers: {'Content-Type': 'application/json'}, body: JSON.stringify({name, template: 'empty'})}) }",
        names,
    )


def test_projects_are_made_ordered_and_never_lost(studio: Studio) -> None:
    expect(studio.page.get_by_text("No projects yet")).to_be_visible()
    studio.page.get_by_role("button", name="Open the bump-and-go example").click()
    expect(studio.at("node-n1")).to_be_visible()
    home(studio)

    choose(studio, "Laser bump and go", "Rename")
    field = studio.page.get_by_role("textbox", name="Rename")
    field.fill("Zig zag")
    field.press("Enter")
    expect(card(studio, "Zig zag")).to_be_visible()
    a_name_is_refused_or_kept_to_the_letter(studio)
    choose(studio, "Zig zag", "Duplicate")
    expect(cards(studio)).to_have_count(2)

    copy = cards(studio).filter(has_text=re.compile(r"Zig zag.+Changed")).first.locator("a[title]")
    copied = str(copy.get_attribute("title"))
    assert copied != "Zig zag"
    choose(studio, copied, "Delete")
    expect(cards(studio)).to_have_count(1)
    studio.page.get_by_role("button", name="Undo").last.click()
    expect(cards(studio)).to_have_count(2)

    choose(studio, copied, "Archive")
    expect(cards(studio)).to_have_count(1)
    shelf(studio, "Archive")
    expect(card(studio, copied)).to_be_visible()
    choose(studio, copied, "Take out of the archive")
    expect(studio.page.get_by_text("The archive is empty.")).to_be_visible()
    shelf(studio, "In use")
    expect(cards(studio)).to_have_count(2)

    choose(studio, copied, "Delete")
    expect(cards(studio)).to_have_count(1)
    shelf(studio, "Deleted")
    card(studio, copied).get_by_role("button", name="Restore").click()
    shelf(studio, "In use")
    expect(card(studio, copied)).to_be_visible()


def a_name_is_refused_or_kept_to_the_letter(studio: Studio) -> None:
    """A blank or too long name is refused with a reason; any character is allowed."""
    odd = "🤖👩‍🔬 <b>“x” & ñ"
    field = studio.page.get_by_role("textbox", name="Rename")
    choose(studio, "Zig zag", "Rename")
    for typed, reason in (("x" * 300, "at most 100"), ("../a", "no slash")):
        field.fill(typed)
        field.press("Enter")
        expect(cards(studio)).to_contain_text(reason)
        expect(field).to_have_value(typed)
    field.fill(odd)
    field.press("Enter")
    expect(card(studio, odd)).to_be_visible()
    choose(studio, odd, "Rename")
    field.fill(" ")
    field.press("Enter")
    expect(field).to_have_count(0)
    choose(studio, odd, "Rename")
    field.fill("Zig zag")
    field.press("Enter")
    expect(card(studio, "Zig zag")).to_be_visible()


def test_everything_on_the_start_page_is_a_command(studio: Studio) -> None:
    """Theme, language, search and a new project by Ctrl+K; theme and language survive a reload."""
    html = studio.page.locator("html")
    before = html.get_attribute("data-mantine-color-scheme")
    studio.command("theme")
    expect(html).not_to_have_attribute("data-mantine-color-scheme", str(before))
    studio.command("spanish")
    expect(studio.page.get_by_role("heading", name="Proyecto nuevo")).to_be_visible()
    studio.page.reload()
    expect(studio.page.get_by_role("heading", name="Proyecto nuevo")).to_be_visible()
    expect(html).not_to_have_attribute("data-mantine-color-scheme", str(before))
    studio.command("inglés")
    studio.command("search")
    expect(studio.page.get_by_role("searchbox")).to_be_focused()
    with studio.page.expect_file_chooser():
        studio.command("import")
    studio.command("new project: empty")
    expect(studio.at("ghost-block")).to_be_visible()
    expect(studio.at("canvas")).to_be_focused()


def shelf(studio: Studio, name: str) -> None:
    studio.at("shelf").click()
    studio.page.get_by_role("option", name=name, exact=True).click()


def test_long_lists_are_searched_sorted_and_paged(studio: Studio) -> None:
    names = [f"Robot {number:03}" for number in range(120)]
    make(studio, names)
    studio.page.reload()
    expect(cards(studio)).to_have_count(48)
    studio.page.get_by_text("Name", exact=True).click()
    search = studio.page.get_by_role("searchbox", name="Search projects")
    with studio.page.expect_response(lambda answer: "search=Robot" in answer.url):
        search.fill("Robot")  # the list shown until then has as many
    expect(studio.at("projects")).to_have_attribute("data-total", "120")
    expect(cards(studio).first).to_contain_text("Robot 000")
    studio.at("more-projects").click()
    expect(cards(studio)).to_have_count(96)
    studio.at("more-projects").click()
    expect(cards(studio)).to_have_count(120)
    expect(studio.at("more-projects")).to_have_count(0)
    search.fill("Robot 07")
    expect(cards(studio)).to_have_count(12)
    search.fill("nothing like it")
    expect(studio.page.get_by_text("No project has the name")).to_be_visible()
    for scheme in ("light", "dark"):
        search.fill("Robot 00")
        expect(cards(studio)).to_have_count(11)
        expect_accessible(studio, scheme)
        studio.picture(f"start-{scheme}")


def test_what_falls_onto_the_page_becomes_a_project(studio: Studio) -> None:
    studio.may_be_refused(r"4\d\d POST /api/v1/projects/import")
    drop(studio, "Night patrol.xml", BTCPP)
    report(studio, "Night patrol.xml")
    expect(studio.at("canvas")).to_have_attribute("data-tree", "Patrol")
    expect(studio.page.get_by_text("Night patrol", exact=True)).to_be_visible()
    home(studio)
    what_is_missing_is_said(studio)

    graph = chain("Sequence", "Wave")
    drop(
        studio,
        "old.zip",
        zipped({"old/graph.json": graph.to_bytes(), "old/actions/Wave.py": ACTION}),
    )
    report(studio, "old.zip")
    expect(studio.page.locator("[data-type=Wave]")).to_be_visible()
    project = studio.page.url.rstrip("/").split("/")[-1]
    exported = studio.page.request.get(f"{studio.server.origin}/api/v1/projects/{project}/export").body()
    home(studio)

    drop(studio, "again.zip", exported)
    report(studio, "again.zip")
    expect(studio.page.locator("[data-type=Wave]")).to_be_visible()
    home(studio)

    drop(studio, "bare.xml", BTCPP.replace(b"<Sequence", b'<Sequence _description="1 < 2 & 3"', 1))
    dialog = studio.page.get_by_role("dialog", name="Repair the file?")
    expect(dialog.get_by_test_id("repairs").get_by_role("row")).to_have_count(3)
    dialog.get_by_role("button", name="Do not import").click()
    expect(studio.at("projects")).to_be_visible()
    drop(studio, "bare.xml", BTCPP.replace(b"<Sequence", b'<Sequence _description="1 < 2 & 3"', 1))
    studio.at("repair").click()
    report(studio, "bare.xml")
    expect(studio.at("canvas")).to_have_attribute("data-tree", "Patrol")
    home(studio)

    drop(studio, "holiday.zip", b"no zip at all")
    expect(studio.page.get_by_text("not a zip that can be read")).to_be_visible()
    expect(studio.at("projects")).to_be_visible()


def test_a_project_is_downloaded_and_brought_back(studio: Studio, tmp_path: Path) -> None:
    """By the card's menu and the button *Import…*: tree, code and name are the same."""
    page = studio.page
    studio.new_from("laser_bump_and_go")
    studio.set_port("n6", "lin_speed", "0.123")
    page.get_by_role("link", name="All projects").click()
    with page.expect_download() as download:
        choose(studio, "Laser bump and go", "Download as zip")
    archive = tmp_path / download.value.suggested_filename
    download.value.save_as(archive)
    assert archive.suffix == ".zip"
    choose(studio, "Laser bump and go", "Delete")
    expect(cards(studio)).to_have_count(0)
    with page.expect_file_chooser() as chooser:
        page.get_by_role("button", name="Import…").click()
    chooser.value.set_files(archive)
    report(studio, archive.name)
    studio.at("node-n6").click()
    expect(studio.at("port-lin_speed")).to_have_value("0.123")
    studio.open_file("actions/Turn.py")
    expect(studio.at("code-editor")).to_contain_text("class Turn")
    home(studio)
    expect(card(studio, "Laser bump and go").locator("a svg")).to_be_visible()
