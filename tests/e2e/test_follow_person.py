"""*Visual follow person*: detected by colour, followed at a distance, lost behind a wall and found again."""

from __future__ import annotations

import bisect
import math
import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.server import wait_until
from tests.e2e.studio import OUTPUT

if TYPE_CHECKING:
    from tests.e2e.observer import Observer
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

WATCHED_S = 60.0


@pytest.mark.long_walk
def test_the_robot_keeps_the_person_in_sight(studio: Studio) -> None:
    studio.new_from("visual_follow_person")
    studio.run()
    observer = studio.observe()
    detect = uid_of(observer, "DetectPerson")
    wait_until(lambda: seen_spans(observer, detect), "the person is found")
    first_seen = seen_spans(observer, detect)[0][0]
    expect(studio.at("camera-inset").locator("canvas")).to_be_visible()
    studio.picture("following")
    expect(studio.at("console")).to_contain_text("Person in sight")
    the_camera_follows_in_a_window_of_its_own(studio)

    end = first_seen + WATCHED_S
    observer.wait_for_sim_time(end + 0.5, deadline_s=WATCHED_S * 3)
    spans = [(max(a, first_seen), min(b, end)) for a, b in seen_spans(observer, detect) if a < end]
    in_sight = sum(b - a for a, b in spans)
    assert in_sight >= 0.8 * WATCHED_S
    assert len(spans) >= 2, "the person was lost behind the wall once, and found again"

    distances = [distance(observer, t) for a, b in spans for t in steps(a, b)]
    assert min(distances) >= 0.8
    assert max(distances) <= 3.0
    assert 0.3 <= walking_speed(observer) <= 0.6
    observer.close()


def the_camera_follows_in_a_window_of_its_own(studio: Studio) -> None:
    """Opened by the command, with the page's theme and its keys; it returns when its window closes."""
    page = studio.page
    window = studio.pop_out("camera")
    figures = re.compile(r"640 × 480 · [\d.]+ Hz · \d+ ms late")
    expect(window.get_by_test_id("camera-figures")).to_have_text(figures)
    expect(page.get_by_role("tab", name="Camera", exact=True)).to_have_count(0)
    picture = window.locator("canvas")
    first = picture.evaluate("canvas => canvas.toDataURL()")
    wait_until(lambda: picture.evaluate("canvas => canvas.toDataURL()") != first, "the picture moves on")

    studio.command_in_window(window, "dark theme")
    for each in (page, window):
        expect(each.locator("html")).to_have_attribute("data-mantine-color-scheme", "dark")
    window.screenshot(path=OUTPUT / "camera-window-dark.png")

    window.evaluate("window.close()")
    expect(page.get_by_role("tab", name="Camera", exact=True)).to_be_visible()


def uid_of(observer: Observer, node_type: str) -> int:
    """Returns the running tree's first node of a type."""
    wait_until(lambda: observer.of("tree") or observer.of("snapshot"), "the tree is reported")
    snapshots = [event["data"]["tree"] for event in observer.of("snapshot") if event["data"]["tree"]]
    nodes = (snapshots or [event["data"] for event in observer.of("tree")])[-1]["nodes"]
    return int(next(node["uid"] for node in nodes if node["type"] == node_type))


def seen_spans(observer: Observer, detect: int) -> list[tuple[float, float]]:
    """Returns when the person was in the picture: spans of simulated time in s, from the node's results."""
    spans: list[tuple[float, float]] = []
    seen_since: float | None = None
    for event in observer.of("tick"):
        for uid, status in event["data"]["changed"] + event["data"]["flashed"]:
            if uid == detect and status == "SUCCESS" and seen_since is None:
                seen_since = event["t"]
            elif uid == detect and status == "FAILURE" and seen_since is not None:
                spans.append((seen_since, event["t"]))
                seen_since = None
    if seen_since is not None:
        spans.append((seen_since, observer.sim_time()))
    return spans


def steps(a: float, b: float) -> list[float]:
    """Returns times from a to b, each 0.2 s."""
    return [a + 0.2 * i for i in range(int((b - a) / 0.2))]


def position(observer: Observer, body: str, t: float) -> tuple[float, float]:
    """Returns the position of a body at time `t`: x and y in m."""
    track = observer.track(body)
    index = min(bisect.bisect_left(track, (t,)), len(track) - 1)
    return track[index][1:]


def distance(observer: Observer, t: float) -> float:
    """Returns the distance between robot and person at time `t` in m."""
    return math.dist(position(observer, "robot", t), position(observer, "person", t))


def walking_speed(observer: Observer) -> float:
    """Returns the person's mean speed in m/s."""
    track = observer.track("person")
    return observer.distance_travelled("person") / (track[-1][0] - track[0][0])
