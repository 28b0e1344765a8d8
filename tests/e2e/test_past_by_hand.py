"""Why did the robot touch a crate? From the mark on the time axis to a link for somebody else."""

from __future__ import annotations

import io
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from mcap.reader import make_reader
from playwright.sync_api import expect
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import LaserScan

from tests.e2e.accessibility import expect_a_heading, expect_no_findings, expect_to_fit
from tests.e2e.server import wait_until
from tests.e2e.studio import Studio
from tests.e2e.test_run_panels import panel
from tests.e2e.view_by_hand import area, changes, metres_a_pixel, tool

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Locator

LOGS = Path(__file__).parents[1] / "executor" / "recorder" / "outside" / "samples"
NARROW_DEG = 2
AHEAD_M = 1.0
# Topics that no node receives are recorded twice a second; times of messages are shown with two decimals.
UNHEARD_S = 0.55
ROUNDED_S = 0.005
pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]


@pytest.mark.long_walk
def test_a_collision_is_understood_kept_and_sent(studio: Studio, browser: Browser) -> None:
    the_robot_touches_a_crate(studio)
    t = the_mark_leads_to_the_moment(studio)
    the_console_leads_to_the_moment(studio)
    the_world_of_the_moment_is_drawn(studio, t)
    the_run_is_kept_and_comes_back_after_a_reload(studio, t)
    the_ray_missed_the_crate(studio, t)
    a_log_is_dropped_beside_it(studio)
    two_runs_stand_beside_each_other(studio)
    somebody_else_follows_the_link(studio, browser, t)


def the_robot_touches_a_crate(studio: Studio) -> None:
    """It looks straight ahead alone, and drives past the corner of a crate."""
    studio.new_from("laser_bump_and_go")
    studio.set_port("n4", "amplitude", str(NARROW_DEG))
    studio.set_port("n6", "lin_speed", "0.6")
    studio.run()
    wait_until(lambda: studio.stat("collisions") > 0, "the robot touches the crate")
    studio.at("pause").click()
    studio.expect_state("paused")


def mark(page_of: Studio) -> Locator:
    return page_of.at("time-axis").get_by_role("button", name=re.compile("^Collision at .* crate_red"))


def shown_t(studio: Studio) -> float:
    return float(studio.at("time-axis").get_attribute("data-shown") or "nan")


def the_mark_leads_to_the_moment(studio: Studio) -> float:
    """The tree says that the way was free: the robot drove on."""
    label = mark(studio).first.get_attribute("aria-label") or ""
    found = re.search(r"at ([\d.]+) s", label)
    assert found
    mark(studio).first.click()
    wait_until(lambda: abs(shown_t(studio) - float(found[1])) < 0.01, "the moment of the collision is shown")
    recorded = studio.at("recorded-canvas")
    expect(recorded.get_by_test_id("node-n6")).to_have_attribute("data-status", "RUNNING")
    expect(recorded.get_by_test_id("node-n4")).to_have_attribute("data-past", "FAILURE")
    return shown_t(studio)


def the_console_leads_to_the_moment(studio: Studio) -> None:
    """By mouse and by keys, from the line about the collision."""
    panel(studio, "Console")
    studio.at("console").get_by_role("searchbox").fill("crate_red")
    line = studio.at("console").locator("[data-source=world]").filter(has_text="crate_red").first
    time = line.get_by_role("button").first
    then = float(time.inner_text())
    for press in (time.click, lambda: time.press("Enter")):
        studio.at("axis-strip").focus()
        studio.page.keyboard.press("Home")
        wait_until(lambda: shown_t(studio) < 1, "the begin is shown")
        studio.page.keyboard.press("Escape")
        expect(studio.at("time-axis")).not_to_have_attribute("data-past", "true")
        press()
        wait_until(lambda: abs(shown_t(studio) - then) < 0.01, f"the moment of the line, {then} s")


def the_world_of_the_moment_is_drawn(studio: Studio, t: float) -> None:
    """In 3D, where the trail leads to other moments, and Escape in a menu closes that alone."""
    tab = studio.page.get_by_role("tab", name="3D", exact=True)
    tab.click()
    bar = studio.page.locator(".flexlayout__tabset_tabbar_outer").filter(has=tab)
    bar.get_by_role("button", name="Maximize").click()
    view = studio.at("viewer-3d")
    expect(view.locator("canvas").first).to_be_visible()
    expect(view.get_by_text("Loading 3D")).to_have_count(0)
    expect(view).not_to_have_attribute("data-objects", "0")
    changes(studio, tool(studio, "Top view").click, "the view from above")
    a_place_of_the_trail_is_clicked(studio, t)
    mark(studio).first.click()
    wait_until(lambda: abs(shown_t(studio) - t) < 0.01, "the moment of the collision is shown")
    tool(studio, "Show in the view").click()
    rays = studio.page.get_by_role("menuitemcheckbox", name="LIDAR rays", exact=True)
    expect(rays).to_have_attribute("aria-checked", "true")
    changes(studio, rays.click, "the rays are hidden")
    changes(studio, rays.click, "the rays of the moment are drawn")
    studio.page.keyboard.press("Escape")
    expect(rays).to_have_count(0)
    expect(studio.at("time-axis")).to_have_attribute("data-past", "true")
    studio.picture("collision-3d")
    bar.get_by_role("button", name="Restore").click()


def a_place_of_the_trail_is_clicked(studio: Studio, t: float) -> None:
    """A metre after the start: the robot was there before it touched the crate."""
    box, canvas = area(studio), studio.at("viewer-3d").locator("canvas").first
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2 - 1 / metres_a_pixel(box)

    def points_at_the_trail() -> bool:
        studio.page.mouse.move(x, y - 1)
        studio.page.mouse.move(x, y)
        return bool(canvas.evaluate("canvas => canvas.style.cursor === 'pointer'"))

    wait_until(points_at_the_trail, "the trail can be clicked")
    studio.picture("trail-from-above")
    studio.page.mouse.click(x, y)
    wait_until(lambda: 0.5 < shown_t(studio) < t - 0.5, "the moment at which the robot was there")


def the_run_is_kept_and_comes_back_after_a_reload(studio: Studio, t: float) -> None:
    page = studio.page
    studio.command("Kept runs")
    dialog = page.get_by_role("dialog", name="Kept runs")
    dialog.get_by_role("textbox", name="Name").fill("Into the crate")
    dialog.get_by_role("textbox", name="Name").press("Enter")
    row = dialog.get_by_role("listitem").filter(has_text="Into the crate")
    expect(row).to_be_visible()
    page.keyboard.press("Escape")
    page.reload()
    wait_until(lambda: abs(shown_t(studio) - t) < 0.01, "a reload loses nothing")
    expect(studio.at("recorded-canvas").get_by_test_id("node-n6")).to_have_attribute("data-status", "RUNNING")
    page.get_by_test_id("axis-live").click()
    studio.end_session()


def the_ray_missed_the_crate(studio: Studio, t: float) -> None:
    """In the file that is downloaded, the rays straight ahead pass the crate, and others hit it."""
    page = studio.page
    studio.command("Kept runs")
    row = (
        page.get_by_role("dialog", name="Kept runs").get_by_role("listitem").filter(has_text="Into the crate")
    )
    with page.expect_download() as downloaded:
        row.get_by_role("link", name="Download the recording").click()
    data = Path(downloaded.value.path()).read_bytes()
    messages = make_reader(io.BytesIO(data)).iter_messages(["/scan"])
    until_ns = round(t * 1e9) + 1_000_000
    *_, last = (message.data for _, _, message in messages if message.log_time <= until_ns)
    scan = deserialize_message(last, LaserScan)
    rays = [(scan.angle_min + i * scan.angle_increment, r) for i, r in enumerate(scan.ranges)]
    half = math.radians(NARROW_DEG / 2)
    ahead = [r for angle, r in rays if abs(math.remainder(angle, math.tau)) <= half]
    assert min(ahead) > AHEAD_M > min(r for _, r in rays if math.isfinite(r))
    page.keyboard.press("Escape")


def a_log_is_dropped_beside_it(studio: Studio) -> None:
    page = studio.page
    data = page.evaluate_handle(
        "bytes => { const all = new DataTransfer();"
        "all.items.add(new File([new Uint8Array(bytes)], 'patrol.btlog')); return all; }",
        list((LOGS / "patrol.btlog").read_bytes()),
    )
    page.dispatch_event("body", "drop", {"dataTransfer": data})
    expect(studio.at("time-axis")).to_contain_text("Kept run: patrol.btlog")
    page.keyboard.press("End")
    studio.at("axis-live").click()


def two_runs_stand_beside_each_other(studio: Studio) -> None:
    """By keys, from the start page."""
    page, runs = studio.page, studio.at("my-runs")
    studio.open()
    log = runs.get_by_role("listitem").filter(has_text="patrol.btlog")
    log.get_by_role("button", name="Commands on").focus()
    page.keyboard.press("Enter")
    with page.expect_popup() as popup:
        page.get_by_role("menuitem", name="Open in a window beside this one").press("Enter")
    expect(popup.value.get_by_test_id("time-axis")).to_contain_text("Kept run: patrol.btlog")
    runs.get_by_role("listitem").filter(has_text="Into the crate").get_by_role("link").first.click()
    expect(studio.at("time-axis")).to_contain_text("Kept run: Into the crate")
    expect(popup.value.get_by_test_id("time-axis")).to_contain_text("Kept run: patrol.btlog")
    popup.value.close()


def the_speed_until_then_is_plotted(studio: Studio) -> None:
    """From the recording alone, where nothing runs: with the moment, and all of the run after it."""
    panel(studio, "Topics")
    studio.at("topic-/odom").get_by_role("button", name="Show /odom").click()
    echo = studio.at("echo-/odom")
    expect(echo).to_have_text(re.compile(r"^/odom\d+\.\d+ s"))
    received = re.match(r"/odom([\d.]+) s", echo.inner_text().replace("\n", ""))
    age_s = shown_t(studio) - float(received[1]) if received else math.nan
    assert -ROUNDED_S <= age_s < UNHEARD_S + ROUNDED_S, "the last one until then"
    for field in ("pose.pose.position.x", "twist.twist.linear.x"):
        echo.get_by_label(f"Plot {field}").click()
    chart = studio.at("plot").get_by_test_id("chart")
    expect(chart).to_have_attribute("data-samples", re.compile(r"^\d{2,}$"))
    expect(studio.at("plot-notes")).to_be_empty()
    expect(studio.at("plot-cursor")).to_be_visible()
    echo.evaluate("element => { element.parentElement.scrollTop = 0; }")


def somebody_else_follows_the_link(studio: Studio, browser: Browser, t: float) -> None:
    """In another browser, where no session is: the link alone shows the moment."""
    page = studio.page
    mark(studio).first.click()
    wait_until(lambda: abs(shown_t(studio) - t) < 0.01, "the moment of the collision is shown")
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    studio.at("axis-link").click()
    expect(page.get_by_text("The link is copied")).to_be_visible()
    link = page.evaluate("navigator.clipboard.readText()")
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    other = Studio(context.new_page(), studio.server)
    other.open()
    other.page.goto(link)
    expect(other.at("time-axis")).to_contain_text("Kept run: Into the crate")
    wait_until(lambda: abs(shown_t(other) - t) < 0.01, "the link's moment is shown")
    expect(other.at("recorded-canvas").get_by_test_id("node-n6")).to_have_attribute("data-status", "RUNNING")
    expect_a_heading(other.page, "a run that somebody sent")
    expect(other.at("viewer-3d")).to_have_attribute("data-objects", re.compile("[1-9]"))
    the_speed_until_then_is_plotted(other)
    for scheme in ("dark", "light"):
        other.page.evaluate(
            "s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme
        )
        expect_no_findings(other.page, f"a run that somebody sent, {scheme}")
        other.picture(f"sent-run-{scheme}")
    other.page.set_viewport_size({"width": 390, "height": 800})
    expect_to_fit(other.page, "a run that somebody sent")
    other.picture("sent-run-narrow")
    assert other.server.children() == [], "nothing was started to look at a kept run"
    context.close()
    assert other.complaints == [], "the browser's console must stay empty"
