"""Runs that are kept with their project."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from mcap.reader import make_reader
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.server import wait_until

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

LOGS = Path(__file__).parents[1] / "executor" / "recorder" / "outside" / "samples"
pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


def test_a_run_is_kept_outlives_its_session_and_is_deleted(studio: Studio) -> None:
    page = studio.page
    studio.new_from("laser_bump_and_go")
    studio.run()
    wait_until(lambda: studio.stat("t") > 2, "the robot has driven")
    studio.at("run-menu").click()
    page.get_by_role("menuitem", name="Kept runs…").click()
    dialog = page.get_by_role("dialog", name="Kept runs")
    dialog.get_by_role("textbox", name="Name").fill("The first drive")
    dialog.get_by_role("textbox", name="Note").fill("It keeps away from the wall.")
    dialog.get_by_test_id("keep-run").click()
    row = dialog.get_by_role("listitem").filter(has_text="The first drive")
    expect(row).to_be_visible()
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"kept runs, {scheme}")
        studio.picture(f"kept-runs-{scheme}")
    page.keyboard.press("Escape")
    studio.end_session()
    page.reload()
    expect(studio.at("canvas")).to_be_visible()

    studio.command("Kept runs")
    expect(row).to_contain_text("It keeps away from the wall.")
    with page.expect_download() as downloaded:
        row.get_by_role("link", name="Download the recording").click()
    data = Path(downloaded.value.path()).read_bytes()
    topics = {channel.topic for _, channel, _ in make_reader(io.BytesIO(data)).iter_messages()}
    assert {"/bt/tick", "/world/poses"} <= topics
    it_is_looked_at_without_a_session(studio)
    studio.command("Kept runs")
    page.set_viewport_size({"width": 390, "height": 800})
    studio.picture("kept-runs-narrow")
    row.get_by_role("button", name="Commands on").click()
    page.get_by_role("menuitem", name="Delete").click()
    row.get_by_role("alert").get_by_role("button", name="Delete").click()
    expect(row).to_have_count(0)
    last = dialog.get_by_role("listitem").filter(has_text="Last run")
    last.get_by_role("button", name="Keep").click()
    expect(last).to_have_count(0)
    expect(dialog.get_by_role("listitem")).to_have_count(1)
    page.set_viewport_size({"width": 1400, "height": 900})
    page.keyboard.press("Escape")
    it_is_opened_from_the_start_page_beside_another_one(studio)


def it_is_opened_from_the_start_page_beside_another_one(studio: Studio) -> None:
    page, runs = studio.page, studio.at("my-runs")
    studio.open()
    row = runs.get_by_role("listitem")
    expect(row).to_contain_text("No result")
    expect(row.locator("img")).to_have_js_property("complete", True)
    assert row.locator("img").evaluate("image => image.naturalWidth") > 50
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"runs on the start page, {scheme}")
        runs.scroll_into_view_if_needed()
        studio.picture(f"start-runs-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    runs.scroll_into_view_if_needed()
    studio.picture("start-runs-narrow")
    page.set_viewport_size({"width": 1400, "height": 900})
    row.get_by_role("button", name="Commands on").focus()
    page.keyboard.press("Enter")
    with page.expect_popup() as popup:
        page.get_by_role("menuitem", name="Open in a window beside this one").press("Enter")
    expect(popup.value.get_by_test_id("time-axis")).to_contain_text("Kept run: ")
    popup.value.close()

    data = page.evaluate_handle(
        "bytes => { const all = new DataTransfer();"
        "all.items.add(new File([new Uint8Array(bytes)], 'patrol.btlog')); return all; }",
        list((LOGS / "patrol.btlog").read_bytes()),
    )
    page.dispatch_event("body", "drop", {"dataTransfer": data})
    expect(studio.at("time-axis")).to_contain_text("Kept run: patrol.btlog")
    expect(studio.at("canvas")).to_contain_text("way is free")
    studio.picture("log-as-project")


def test_the_log_of_another_robot_is_opened_on_the_axis(studio: Studio) -> None:
    page, axis = studio.page, studio.at("time-axis")
    studio.new_from("laser_bump_and_go")
    studio.command("Kept runs")
    dialog = page.get_by_role("dialog", name="Kept runs")
    expect(dialog.get_by_role("button", name="Open a log of a robot…")).to_be_visible()
    studio.picture("kept-runs-open-log")
    dialog.locator("input[type=file]").set_input_files(LOGS / "patrol.btlog")
    expect(dialog).to_have_count(0)
    expect(axis).to_contain_text("Kept run: patrol.btlog")
    strip = page.get_by_role("slider", name="Moment of the run")
    strip.focus()
    page.keyboard.press("End")
    recorded = studio.at("recorded-canvas")
    patrol = recorded.get_by_test_id(re.compile("^node-")).filter(has_text="patrol").first
    expect(patrol).to_be_visible()
    tab = studio.at("past-tab")
    tab.get_by_text("List", exact=True).click()
    row = tab.get_by_role("listitem").filter(has_text="patrol")
    expect(row).to_have_attribute("data-status", "SUCCESS")
    studio.picture("log-of-a-robot-list")
    tab.get_by_text("Canvas", exact=True).click()
    expect(patrol).to_have_attribute("data-past", "SUCCESS")
    page.get_by_role("tab", name="Timeline", exact=True).click()
    line = studio.at("timeline").get_by_role("button", name=re.compile("^patrol"))
    expect(line).to_be_visible()
    strip.focus()
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        studio.picture(f"log-of-a-robot-{scheme}")
    page.keyboard.press("Escape")
    expect(line).to_have_count(0)
    expect(axis).to_have_count(0)
    expect(recorded).to_have_count(0)

    studio.may_be_refused("422 POST .*/runs/logs")
    data = page.evaluate_handle(
        "bytes => { const all = new DataTransfer();"
        "all.items.add(new File([new Uint8Array(bytes)], 'broken.btlog')); return all; }",
        list((LOGS / "patrol.btlog").read_bytes()[:300]),
    )
    page.dispatch_event("body", "drop", {"dataTransfer": data})
    expect(page.get_by_text("The log cannot be opened")).to_be_visible()
    expect(page.get_by_text("it ends within its tree")).to_be_visible()
    studio.picture("log-refused")


def it_is_looked_at_without_a_session(studio: Studio) -> None:
    page, axis = studio.page, studio.at("time-axis")
    expect(axis).to_have_count(0)
    page.get_by_role("button", name="The first drive", exact=True).click()
    expect(axis).to_have_attribute("data-past", "true")
    expect(axis).to_contain_text("Kept run: The first drive")
    strip = page.get_by_role("slider", name="Moment of the run")
    strip.focus()
    page.keyboard.press("Shift+ArrowRight")
    expect(studio.at("recorded-canvas").get_by_test_id("node-n1")).to_have_attribute("data-status", "RUNNING")
    expect(studio.at("run")).to_be_disabled()
    studio.picture("kept-run-open")
    then = axis.get_attribute("data-shown") or ""
    # The address follows a little later.
    expect(page).to_have_url(re.compile(rf"\?run=[0-9a-f-]{{36}}&t={float(then):g}"))
    page.reload()
    expect(axis).to_contain_text("Kept run: The first drive")
    expect(axis).to_have_attribute("data-shown", then)
    expect(studio.at("recorded-canvas").get_by_test_id("node-n1")).to_have_attribute("data-status", "RUNNING")
    the_world_of_the_run_is_drawn(studio)
    what_changed_since_is_marked(studio)
    expect(axis).to_have_count(0)
    expect(studio.at("run")).to_be_enabled()


def the_world_of_the_run_is_drawn(studio: Studio) -> None:
    """Nothing was started since the page was loaded."""
    studio.page.get_by_role("tab", name="3D").click()
    view = studio.at("viewer-3d")
    expect(view).not_to_have_attribute("data-objects", "0")
    expect(view.locator("canvas").first).to_be_visible()
    expect(view.get_by_text("Loading 3D")).to_have_count(0)
    studio.picture("kept-run-3d")


def what_changed_since_is_marked(studio: Studio) -> None:
    """The project is edited after the run; the edit returns to the present, and undo is as ever."""
    page = studio.page
    strip = page.get_by_role("slider", name="Moment of the run")
    strip.focus()
    page.keyboard.press("Escape")
    studio.at("canvas").get_by_test_id("node-n1").click()
    page.keyboard.press("ArrowDown")
    page.keyboard.press("Delete")
    studio.command("Kept runs")
    page.get_by_role("button", name="The first drive", exact=True).click()
    page.get_by_role("button", name="Compare with now").click()
    expect(studio.at("past-since")).to_contain_text("blocks changed since the run")
    expect(studio.at("recorded-canvas").locator("[class*=mark_removed]").first).to_be_visible()
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"changed since the run, {scheme}")
        studio.picture(f"changed-since-{scheme}")
    strip.focus()
    page.keyboard.press("Escape")
    page.keyboard.press("Control+z")
    expect(studio.at("canvas").get_by_test_id("node-n2")).to_be_visible()
