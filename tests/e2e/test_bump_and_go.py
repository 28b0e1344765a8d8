"""*Laser bump and go*, from the start page to a robot that moves, as described in the README."""

from __future__ import annotations

import itertools
import math
import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.budget import count
from tests.e2e.server import RARELY_S, wait_until
from tests.e2e.view_by_hand import the_robot_is_driven_by_hand, the_view_is_used_by_hand

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import Browser

    from tests.e2e.observer import Observer
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

WATCHED_S = float(count("e2e_watched_s"))
LEAST_M, LEAST_TURNS = WATCHED_S / 12, WATCHED_S // 30


def test_the_example_drives_and_turns_and_the_page_shows_why(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.picture("editor-light")
    studio.choose("sim-speed", "×2")
    studio.run()
    observer = studio.observe()
    started = observer.sim_time()

    for status in ("RUNNING", "IDLE", "RUNNING"):
        expect(studio.at("node-n6")).to_have_attribute("data-status", status)
    expect(studio.at("console")).to_contain_text("driving ahead")
    expect(studio.at("viewer-3d")).to_be_visible()
    studio.picture("running-light")

    observer.wait_for_sim_time(started + WATCHED_S)
    assert observer.distance_travelled("robot") > LEAST_M
    assert turns(observer) >= LEAST_TURNS
    assert observer.of("sim")[-1]["data"]["collisions"] == 0
    assert studio.stat("collisions") == 0
    wait_until(
        lambda: abs(studio.stat("distance") - observer.of("sim")[-1]["data"]["distance_m"]) < 1.5,
        "the page shows the distance that the world reports",
    )
    observer.close()


def test_pause_step_stop_and_end(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.run()
    observer = studio.observe()
    wait_until(lambda: observer.distance_travelled("robot") > 0.2, "the robot moves")
    the_tree_shows_its_path(studio)

    studio.at("pause").click()
    studio.expect_state("paused")
    frozen = still(observer, studio)
    ticks = len(observer.of("tick"))
    assert still(observer, studio) == frozen, "the world is paused"
    assert len(observer.of("tick")) == ticks, "the tree is paused"

    studio.at("step").click()
    wait_until(lambda: len(observer.of("tick")) == ticks + 1, "one tick is made")
    studio.page.wait_for_timeout(500)  # the time is the test: no second tick may come
    assert len(observer.of("tick")) == ticks + 1
    assert observer.sim_time() == pytest.approx(frozen + 0.05, abs=0.02), "a step is one period of 20 Hz"

    the_view_is_used_by_hand(studio, observer)

    studio.at("resume").click()
    studio.expect_state("application_running")
    wait_until(lambda: observer.sim_time() > frozen + 1, "time continues")

    studio.at("stop").click()
    studio.expect_state("visualization_ready")
    assert studio.server.children(), "the world is still up"
    the_robot_is_driven_by_hand(studio)
    observer.close()
    studio.end_session()
    studio.expect_state("idle")


def the_tree_shows_its_path(studio: Studio) -> None:
    """Running nodes are marked down to the leaf; results within a tick flash."""
    running = studio.at("canvas").locator(".react-flow__edge [data-status=RUNNING]")
    expect(running).to_have_count(1)
    expect(studio.at("node-n4")).to_have_attribute("data-flash", re.compile("."))


def test_a_port_and_a_line_of_python_change_what_the_robot_does(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.set_port("n6", "lin_speed", "0.12")
    studio.choose("sim-speed", "×2")
    studio.run()
    assert speed_when_driving(studio) == pytest.approx(0.12, abs=0.03)

    studio.set_port("n6", "lin_speed", "0.4")
    studio.run()
    assert speed_when_driving(studio) == pytest.approx(0.4, abs=0.06)

    studio.open_file("actions/Forward.py")
    source = studio.page.evaluate(
        "project => fetch(`/api/v1/projects/${project}`).then(r => r.json())"
        ".then(p => p.files.find(f => f.path === 'actions/Forward.py').content)",
        studio.page.url.rstrip("/").split("/")[-1],
    )
    studio.replace_code(source.replace('get_input(self, "lin_speed")', '-0.5 * get_input(self, "lin_speed")'))
    studio.run()
    observer = studio.observe()
    wait_until(lambda: observer.track("robot"), "the scene is sent")
    start = observer.track("robot")[0]
    wait_until(lambda: observer.track("robot")[-1][1] < start[1] - 0.1, "the robot drives backwards")
    observer.close()


@pytest.mark.long_walk
def test_without_webgl_the_server_draws_the_world(
    open_studio: Callable[[Browser], Studio], browser_without_webgl: Browser
) -> None:
    studio = open_studio(browser_without_webgl)
    studio.new_from("laser_bump_and_go")
    studio.run()
    expect(studio.at("viewer-video")).to_be_visible()
    picture = studio.at("viewer-video").locator("img, canvas").first
    first = picture.screenshot()
    wait_until(lambda: picture.screenshot() != first, "the picture of the world changes", every_s=RARELY_S)
    studio.picture("running-without-webgl")

    observer = studio.observe()
    started = observer.sim_time()
    observer.wait_for_sim_time(started + WATCHED_S)
    assert observer.distance_travelled("robot") > LEAST_M
    assert observer.of("sim")[-1]["data"]["collisions"] == 0
    assert turns(observer) >= LEAST_TURNS
    observer.close()


def turns(observer: Observer) -> int:
    """Returns how often the robot changed its heading by more than 20° between two straight parts."""
    track = observer.track("robot")
    headings = []
    for a, b in itertools.pairwise(track[::15]):
        if math.dist(a[1:], b[1:]) > 0.05:
            headings.append(math.atan2(b[2] - a[2], b[1] - a[1]))
    changes = (abs(math.remainder(b - a, math.tau)) for a, b in itertools.pairwise(headings))
    return sum(change > math.radians(20) for change in changes)


def still(observer: Observer, studio: Studio) -> float:
    """Returns the simulated time once no message is on its way any more."""
    # The time is the test, too: 500 ms are ten periods of the world's poses, in which nothing may move.
    studio.page.wait_for_timeout(500)
    return observer.sim_time()


def speed_when_driving(studio: Studio) -> float:
    """Returns the robot's speed in m/s over the fastest half second: on a busy machine it may pause."""
    observer = studio.observe()
    wait_until(lambda: len(observer.track("robot")) > 30, "the robot moves")
    observer.wait_for_sim_time(observer.sim_time() + 2.5)
    track = observer.track("robot")
    observer.close()
    speeds = []
    for end in track:
        begin = next(point for point in track if point[0] >= end[0] - 0.5)
        if end[0] - begin[0] > 0.4:
            speeds.append(math.dist(begin[1:], end[1:]) / (end[0] - begin[0]))
    return max(speeds)
