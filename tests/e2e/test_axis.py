"""The time axis: looking back at a run, with everything that belonged to the moment."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.server import wait_until
from tests.e2e.test_run_panels import panel

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser, Locator

    from tests.e2e.observer import Observer
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

NODES = re.compile("^node-n[0-9]+$")


def test_the_past_of_a_run_is_looked_at(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.new_from("follow_line")
    studio.run()
    observer = studio.observe()
    panel(studio, "Blackboard")
    wait_until(lambda: studio.stat("t") > 6, "the robot follows the line for a while")
    studio.at("pause").click()
    studio.expect_state("paused")
    present = shown_values(studio)
    a_drag_shows_the_past(studio)
    the_tree_as_it_ran_is_looked_at(studio)
    nothing_acts_on_the_robot(studio)
    each_tick_shows_what_was_seen_then(studio, observer)
    why_is_answered_as_the_run_was(studio, observer)
    what_changed_is_listed(studio)
    flags_are_set_seen_by_others_and_removed(studio, observer)
    it_plays(studio)
    the_address_brings_it_back(studio)
    escape_returns_to_the_present(studio, present)
    observer.close()
    studio.end_session()


def axis(studio: Studio) -> Locator:
    return studio.at("time-axis")


def shown_values(studio: Studio) -> dict[str, str]:
    """Returns what the blackboard panel shows."""
    rows = studio.at("blackboard").locator("tbody tr")
    return {row.get_attribute("data-testid") or "": value(row) for row in rows.all()}


def value(row: Locator) -> str:
    field = row.locator("input, select")
    return field.input_value() if field.count() else row.locator("td").first.inner_text().split("\n")[0]


def tick(studio: Studio) -> int:
    return int(studio.at("moment-stats").get_attribute("data-tick") or "-1")


def shown_t(studio: Studio) -> float:
    return float(axis(studio).get_attribute("data-shown") or "nan")


def a_drag_shows_the_past(studio: Studio) -> None:
    strip = studio.at("axis-strip")
    box = strip.bounding_box()
    assert box
    mouse, middle = studio.page.mouse, box["y"] + box["height"] / 2
    mouse.move(box["x"] + box["width"] * 0.9, middle)
    mouse.down()
    mouse.move(box["x"] + box["width"] * 0.5, middle, steps=5)
    mouse.up()
    expect(studio.at("moment-stats")).to_be_visible()
    expect(studio.at("blackboard").get_by_test_id("written").first).to_contain_text(re.compile(r"since .* s"))
    end = float(strip.get_attribute("aria-valuemax") or "nan")
    wait_until(lambda: 0.4 < shown_t(studio) / end < 0.6, "the middle of the run is shown")
    studio.picture("axis")


def the_tree_as_it_ran_is_looked_at(studio: Studio) -> None:
    """In a tab of its own, which cannot be edited, and which a phone and both themes show."""
    page, canvas = studio.page, studio.at("recorded-canvas")
    expect(page.get_by_role("tab", name="As it ran")).to_have_attribute("aria-selected", "true")
    expect(studio.at("past-tab")).to_contain_text("As it ran, at")
    canvas.focus()
    page.keyboard.press("Home")
    page.keyboard.press("ArrowDown")
    expect(studio.at("past-details")).to_be_visible()
    page.keyboard.press("Delete")
    expect(axis(studio)).to_have_attribute("data-past", "true")
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"the tree as it ran, {scheme}")
        studio.picture(f"as-it-ran-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    expect(canvas).to_be_visible()
    studio.picture("as-it-ran-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    expect(canvas).to_be_visible()


def nothing_acts_on_the_robot(studio: Studio) -> None:
    expect(studio.at("run")).to_have_attribute("aria-disabled", "true")
    expect(studio.at("resume")).to_be_disabled()
    expect(studio.at("step")).to_be_disabled()
    expect(studio.at("blackboard").locator("input, select")).to_have_count(0)


def each_tick_shows_what_was_seen_then(studio: Studio, observer: Observer) -> None:
    """The statuses equal those that a second client heard; it knows nothing of the recording."""
    studio.at("axis-strip").focus()
    for _ in range(8):
        before = tick(studio)
        studio.page.keyboard.press("ArrowLeft")
        expect(studio.at("moment-stats")).to_have_attribute("data-tick", str(before - 1))
        heard = statuses_at(observer, before - 1)
        for block in studio.at("recorded-canvas").get_by_test_id(NODES).all():
            node = (block.get_attribute("data-testid") or "").removeprefix("node-")
            expect(block).to_have_attribute("data-status", heard.get(node, "IDLE"))


def why_is_answered_as_the_run_was(studio: Studio, observer: Observer) -> None:
    """Each block has an answer, and no answer contradicts what a second client heard of the tick."""
    number = tick(studio)
    told = next(e["data"] for e in observer.events if e["command"] == "tick" and e["data"]["n"] == number)
    snapshot = next(event["data"] for event in observer.events if event["command"] == "snapshot")
    blocks = {node["uid"]: node["node_id"] for node in snapshot["tree"]["nodes"]}
    returned = {blocks[uid] for uid, status in told["changed"] + told["flashed"] if status != "IDLE"}
    for block in studio.at("recorded-canvas").get_by_test_id(NODES).all():
        block.click(position={"x": 4, "y": 4})
        studio.page.keyboard.press("Alt+w")
        question = studio.at("why-question")
        expect(question).to_contain_text(f"(tick {number})")
        node = (block.get_attribute("data-testid") or "").removeprefix("node-")
        assert node not in returned or "not ticked" not in question.inner_text()
    studio.picture("why")
    studio.at("why-step").first.click()
    panel(studio, "Blackboard")
    studio.at("axis-strip").focus()


def what_changed_is_listed(studio: Studio) -> None:
    """By keys: two moments are marked, their differences listed, the part zoomed, and all taken back."""
    press = studio.page.keyboard.press
    press("Alt+[")
    press("Shift+ArrowRight")
    press("Alt+]")
    press("Alt+d")
    changes = studio.at("axis-changes")
    expect(changes.get_by_test_id("axis-change").filter(has_text="moved").first).to_be_visible()
    press("Alt+=")
    expect(studio.at("axis-end-A")).to_be_visible()
    studio.picture("changes")
    press("Alt+d")
    expect(changes).to_have_count(0)
    press("Alt+0")
    studio.at("axis-menu").click()
    studio.at("axis-time.clearRange").click()
    expect(studio.at("axis-end-A")).to_have_count(0)
    studio.at("axis-strip").focus()


def flags_are_set_seen_by_others_and_removed(studio: Studio, observer: Observer) -> None:
    """By keys, at a moment of the past; another client sees each change at once, also a newcomer."""
    page, press = studio.page, studio.page.keyboard.press
    studio.at("axis-strip").focus()
    press("Home")
    for _ in range(3):
        press("Shift+ArrowRight")
    then = float(axis(studio).get_attribute("data-t") or "nan")
    press("Alt+m")
    page.keyboard.type("It finds the line")
    press("Enter")
    mark = axis(studio).get_by_role("button", name=re.compile("^Flag .*It finds the line"))
    expect(mark).to_be_visible()
    expect(studio.at("axis-strip")).to_be_focused()
    wait_until(lambda: observer.of("flag"), "another client hears of the flag")
    flag = observer.of("flag")[-1]["data"]
    assert (flag["text"], round(flag["t"], 2)) == ("It finds the line", round(then, 2))
    newcomer = studio.observe()
    wait_until(lambda: newcomer.of("snapshot"), "a newcomer hears of the session")
    assert [each["text"] for each in newcomer.of("snapshot")[-1]["data"]["flags"]] == ["It finds the line"]
    newcomer.close()
    press("End")
    press("Alt+Shift+[")
    wait_until(lambda: abs(shown_t(studio) - then) < 0.01, "the flag is the mark before the end")
    press("Alt+Shift+m")
    marks = studio.at("axis-marks")
    line = marks.get_by_test_id("mark-line").filter(has_text="It finds the line")
    line.get_by_test_id("mark-edit").click()
    studio.at("flag-text").fill("It turns here")
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"flags, {scheme}", "[data-testid=axis-marks], [data-testid=flag-form]")
        studio.picture(f"flags-{scheme}")
    page.set_viewport_size({"width": 390, "height": 800})
    studio.picture("flags-narrow")
    page.set_viewport_size({"width": 1440, "height": 900})
    studio.at("flag-keep").click()
    line = marks.get_by_test_id("mark-line").filter(has_text="It turns here")
    line.get_by_test_id("mark-remove").click()
    expect(line).to_have_count(0)
    page.get_by_role("button", name="Undo", exact=True).last.click()
    expect(line).to_have_count(1)
    said = ["It turns here", "", "It turns here"]
    wait_until(
        lambda: [each["data"]["text"] for each in observer.of("flag")][1:] == said,
        "the others hear of the flag, of its end, and of its return",
    )
    marks.get_by_role("button", name="Close the list of marks").click()
    studio.at("axis-strip").focus()


def statuses_at(observer: Observer, number: int) -> dict[str, str]:
    """Returns the statuses by block after a tick, from the events of a session."""
    snapshot = next(event["data"] for event in observer.events if event["command"] == "snapshot")
    blocks = {node["uid"]: node["node_id"] for node in snapshot["tree"]["nodes"]}
    changes = list(snapshot["statuses"])
    for event in observer.events:
        if event["command"] == "tick" and event["data"]["n"] <= number:
            changes += event["data"]["changed"]
    return {blocks[uid]: status for uid, status in changes}


def it_plays(studio: Studio) -> None:
    before = shown_t(studio)
    studio.at("axis-play").click()
    wait_until(lambda: shown_t(studio) > before + 0.5, "the recording is played")
    studio.at("axis-play").click()
    expect(axis(studio).get_by_role("button", name="Play the recording")).to_be_visible()


def the_address_brings_it_back(studio: Studio) -> None:
    studio.at("axis-strip").focus()
    studio.page.keyboard.press("Home")
    studio.page.keyboard.press("Shift+ArrowRight")
    studio.page.keyboard.press("Shift+ArrowRight")
    expect(studio.page).to_have_url(re.compile(r"\?run=[0-9a-f]+&t=2\.\d"))
    then, number = shown_t(studio), tick(studio)
    panel(studio, "Blackboard")  # the question before this has brought the inspector to the front
    values = shown_values(studio)
    studio.page.reload()
    expect(axis(studio)).to_have_attribute("data-shown", f"{then:.3f}")
    expect(studio.at("moment-stats")).to_have_attribute("data-tick", str(number))
    panel(studio, "Blackboard")
    expect(studio.at("blackboard").get_by_test_id("written").first).to_be_visible()
    assert shown_values(studio) == values


def escape_returns_to_the_present(studio: Studio, present: dict[str, str]) -> None:
    assert shown_values(studio) != present
    studio.page.keyboard.press("Escape")
    expect(axis(studio)).not_to_have_attribute("data-past", "true")
    expect(studio.at("sim-stats")).to_be_visible()
    expect(studio.at("run")).to_have_attribute("aria-disabled", "false")
    assert shown_values(studio) == present
    expect(studio.page).to_have_url(re.compile(r"/projects/[^?]+$"))
