"""The 3D view by hand: it follows until the camera is moved, gives way to Video, and stays small."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.studio import Studio
from tests.e2e.view_by_hand import area, tool

if TYPE_CHECKING:
    from collections.abc import Iterator

    from playwright.sync_api import Browser

    from tests.e2e.server import Server

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(300)]

# Every picture of the page waits, as on a machine whose graphics are too slow.
# Without such canvases the page draws by itself, as in older browsers.
SLOW_PICTURES = """
    delete window.OffscreenCanvas;
    const soon = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (draw) => setTimeout(() => soon(draw), 450);
"""


def test_the_view_follows_until_it_is_moved_and_leaves_room(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.run()
    expect(studio.at("viewer-3d").locator("canvas").first).to_be_visible()
    follow = studio.at("viewer-3d").get_by_role("button", name="Follow", exact=True)
    expect(follow).to_have_count(0)
    expect(tool(studio, "Follow the robot")).to_have_attribute("aria-pressed", "true")
    studio.picture("view-first")
    turn_the_view(studio)
    expect(tool(studio, "Follow the robot")).to_have_attribute("aria-pressed", "false")
    follow.click()
    expect(follow).to_have_count(0)

    tool(studio, "Drive by hand").click()
    pad = studio.at("teleop")
    expect(pad.get_by_role("slider").first).to_be_visible()
    studio.page.set_viewport_size({"width": 1000, "height": 520})
    keys = pad.get_by_role("button", name="Driving keys")
    expect(keys).to_be_visible()
    expect(pad.get_by_role("slider")).to_have_count(0)
    studio.picture("view-cramped")
    keys.click()
    pad.get_by_role("button", name="Fold the driving pad").click()
    pad.get_by_role("button", name="Stop driving by hand").click()
    studio.page.set_viewport_size({"width": 1440, "height": 900})

    window = studio.pop_out("3D")
    expect(window.get_by_test_id("viewer-3d").locator("canvas").first).to_be_visible()
    studio.page.get_by_role("tab", name="Video", exact=True).click()
    expect(studio.at("viewer-video")).to_have_count(0)
    studio.page.get_by_role("button", name="Show Video here too").click()
    expect(studio.at("view-figures")).to_be_visible()
    window.evaluate("window.close()")
    expect(studio.page.get_by_role("tab", name="3D", exact=True)).to_be_visible()
    studio.end_session()


def turn_the_view(studio: Studio) -> None:
    """By dragging in a corner where nothing stands."""
    mouse, box = studio.page.mouse, area(studio)
    x, y = box["x"] + 30, box["y"] + box["height"] - 30
    mouse.move(x, y)
    mouse.down()
    mouse.move(x + 90, y - 30, steps=4)
    mouse.up()


@pytest.fixture
def slow_studio(server: Server, browser: Browser) -> Iterator[Studio]:
    context = browser.new_context(viewport={"width": 1440, "height": 900})
    context.add_init_script(SLOW_PICTURES)
    studio = Studio(context.new_page(), server, keeps_3d=False)
    studio.open()
    yield studio
    context.close()
    assert studio.complaints == [], "the browser's console must stay empty"


@pytest.mark.long_walk
def test_3d_that_is_too_slow_gives_way_to_video(slow_studio: Studio) -> None:
    studio = slow_studio
    studio.new_from("laser_bump_and_go")
    studio.run()
    video = studio.at("video-instead")
    expect(video.get_by_role("status")).to_contain_text(re.compile(r"3D drew only .* pictures a second"))
    expect(video.get_by_test_id("view-figures")).to_be_visible()
    studio.picture("view-slow")
    video.get_by_role("button", name="Back to 3D").click()
    expect(studio.at("viewer-3d").locator("canvas").first).to_be_visible()
    studio.page.reload()
    expect(studio.at("viewer-3d").locator("canvas").first).to_be_visible()
    expect(video).to_have_count(0)
    studio.end_session()
