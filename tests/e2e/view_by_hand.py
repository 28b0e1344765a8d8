"""Mouse and keyboard in the 3D view: in a paused world, and while driving in a waiting one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from playwright.sync_api import expect

from tests.e2e.server import RARELY_S, wait_until

if TYPE_CHECKING:
    from collections.abc import Callable

    from playwright.sync_api import FloatRect, Locator

    from tests.e2e.observer import Observer
    from tests.e2e.studio import Studio

BUTTON_PX = 48
LAYERS = ("LIDAR rays", "Trail", "Grid", "Coordinate frames", "Camera's field of view")
# The camera over the walled room by `look` of viewer/Surroundings.tsx and the view's angle, in m.
ROOM_DIAGONAL_M = math.hypot(10.4, 10.4, 1.4)
HEIGHT_M = 0.2 + 1.05 * ROOM_DIAGONAL_M
HALF_VIEW = math.tan(math.radians(45 / 2))


def the_view_is_used_by_hand(studio: Studio, observer: Observer) -> None:
    """The view is turned, filled with layers, measured in, and bodies are dragged in it."""
    tab = studio.page.get_by_role("tab", name="3D", exact=True)
    bar = studio.page.locator(".flexlayout__tabset_tabbar_outer").filter(has=tab)
    bar.get_by_role("button", name="Maximize").click()
    expect(studio.at("canvas")).to_be_hidden()
    the_view_is_turned(studio)
    layers_come_and_go(studio)
    changes(studio, tool(studio, "Top view").click, "the view from above")
    a_distance_is_measured(studio)
    bodies_are_carried_and_put_back(studio, observer)
    studio.picture("view-from-above")
    bar.get_by_role("button", name="Restore").click()
    expect(studio.at("canvas")).to_be_visible()


def tool(studio: Studio, name: str) -> Locator:
    """Returns a button of the 3D view."""
    return studio.at("viewer-3d").get_by_role("button", name=name, exact=True)


def area(studio: Studio) -> FloatRect:
    """Returns the rectangle of the drawing on the page."""
    box = studio.at("viewer-3d").locator("canvas").first.bounding_box()
    assert box
    return box


def drawn(studio: Studio) -> bytes:
    """Returns the drawing without the page's buttons: tools and menus at the right, *Follow* below."""
    box = area(studio)
    return studio.page.screenshot(
        clip={**box, "width": box["width"] * 0.7, "height": box["height"] - BUTTON_PX}
    )


def changes(studio: Studio, gesture: Callable[[], None], what: str) -> None:
    """Makes a gesture and waits until the drawing changes."""
    before = drawn(studio)
    gesture()
    wait_until(lambda: drawn(studio) != before, what, every_s=RARELY_S)


def at_rest(studio: Studio) -> bytes:
    """Returns the drawing once it has stayed the same for 2 s."""
    found = [drawn(studio)]

    def stays() -> bool:
        studio.page.wait_for_timeout(2000)  # the time is the test: a late frame would come in it
        found.append(drawn(studio))
        return found[-1] == found[-2]

    wait_until(stays, "the view is at rest")
    return found[-1]


def default_view(studio: Studio, leave: Callable[[], None]) -> bytes:
    """Returns the drawing of the default view; `leave` moves the pointer away from the buttons.

    The worker frames a view by the area that it knows, and learns of a larger one some time after the page.
    So the view is requested until two drawings in a row are equal: no time says when it has learned.
    """
    found = [b""]

    def is_settled() -> bool:
        # A worker draws some time after a click: a view is known to be drawn when another one was before.
        changes(studio, tool(studio, "Top view").click, "the view from above")
        changes(studio, tool(studio, "Default view").click, "the default view")
        leave()
        found.append(at_rest(studio))
        return found[-1] == found[-2]

    wait_until(is_settled, "the default view is settled")
    return found[-1]


def the_view_is_turned(studio: Studio) -> None:
    """By the three gestures; *Default view* reverts each, to the pixel."""
    mouse, box = studio.page.mouse, area(studio)
    x, y = box["x"] + 60, box["y"] + box["height"] - 60  # where nothing stands that could be dragged

    def drag(button: str) -> None:
        mouse.move(x, y)
        mouse.down(button=button)  # type: ignore[arg-type]
        mouse.move(x + 90, y - 40, steps=4)
        mouse.up(button=button)  # type: ignore[arg-type]

    def scroll() -> None:
        mouse.move(x, y)
        mouse.wheel(0, -300)

    gestures = {
        "the view turns": lambda: drag("left"),
        "the view moves": lambda: drag("right"),
        "the view comes nearer": scroll,
    }
    expect(studio.at("viewer-3d").get_by_text("Loading 3D")).to_have_count(0, timeout=180_000)
    home = default_view(studio, lambda: mouse.move(x, y))
    for what, gesture in gestures.items():
        changes(studio, gesture, what)
        tool(studio, "Default view").click()
        mouse.move(x, y)
        wait_until(lambda: drawn(studio) == home, f"after {what}: the default view", every_s=RARELY_S)


def layers_come_and_go(studio: Studio) -> None:
    """Each layer is visible, and leaves no trace when it is switched off."""
    tool(studio, "Show in the view").click()
    rays = studio.page.get_by_role("menuitemcheckbox", name=LAYERS[0], exact=True)
    for _ in range(2):  # requested again, the scan is the current one
        changes(studio, rays.click, "the scan is requested again")
    for layer in LAYERS:
        item = studio.page.get_by_role("menuitemcheckbox", name=layer, exact=True)
        was, before = item.get_attribute("aria-checked") or "", drawn(studio)
        changes(studio, item.click, f"{layer}: another drawing")
        expect(item).not_to_have_attribute("aria-checked", was)
        item.click()
        expect(item).to_have_attribute("aria-checked", was)
        until = f"{layer}: as before"
        wait_until(lambda: drawn(studio) == before, until, every_s=RARELY_S)  # noqa: B023 - called at once
    camera = studio.page.get_by_role("menuitemcheckbox", name="Robot's camera", exact=True)
    camera.click()
    expect(studio.at("camera-inset")).to_be_visible()
    camera.click()
    expect(studio.at("camera-inset")).to_have_count(0)
    studio.page.keyboard.press("Escape")


def a_distance_is_measured(studio: Studio) -> None:
    """Between two clicks on the floor, whose distance below is the width of the room."""
    mouse, box = studio.page.mouse, area(studio)
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2 + 100
    measured = studio.at("measured")
    tool(studio, "Measure a distance").click()
    expect(measured).to_contain_text("first")
    mouse.click(x - 60, y)
    expect(measured).to_contain_text("second")
    mouse.click(x + 60, y)
    expect(measured).to_contain_text("over the ground")
    metres = float(measured.get_attribute("data-m") or "nan")
    assert abs(metres - 120 * metres_a_pixel(box)) < 0.05 * metres
    tool(studio, "Stop measuring").click()
    expect(measured).to_have_count(0)


def metres_a_pixel(box: FloatRect) -> float:
    """On the floor, from above."""
    return 2 * HALF_VIEW * HEIGHT_M / box["height"]


def bodies_are_carried_and_put_back(studio: Studio, observer: Observer) -> None:
    mouse, box = studio.page.mouse, area(studio)
    canvas, moved = studio.at("viewer-3d").locator("canvas").first, studio.at("moved")
    scale = metres_a_pixel(box)
    for body in ("robot", "crate_red"):
        x, y = at(observer, body)
        # From above, x is up and y is to the left.
        left = box["x"] + box["width"] / 2 - y / scale
        top = box["y"] + box["height"] / 2 - x / scale
        mouse.move(left, top)
        wait_until(lambda: canvas.evaluate("canvas => canvas.style.cursor") == "grab", f"{body} can be taken")
        mouse.down()
        mouse.move(left - 20, top + 40, steps=4)
        mouse.up()
        expect(moved).to_contain_text(f"{body} was moved")
        wait_until(lambda: math.dist(at(observer, body), (x, y)) > 0.4, f"{body} is elsewhere")  # noqa: B023
        moved.get_by_role("button", name="Put it back").click()
        expect(moved).to_have_count(0)
        wait_until(lambda: math.dist(at(observer, body), (x, y)) < 0.02, f"{body} is back")  # noqa: B023


def at(observer: Observer, body: str) -> tuple[float, float]:
    """Returns the position of a body in m."""
    return observer.track(body)[-1][1:]


def the_robot_is_driven_by_hand(studio: Studio) -> None:
    """With keys and with the buttons; the view stays, or follows."""
    page, pad = studio.page, studio.at("teleop")
    box = area(studio)
    corner: FloatRect = {"x": box["x"], "y": box["y"] + box["height"] - 60, "width": 60, "height": 60}
    follow = tool(studio, "Follow the robot")
    if follow.get_attribute("aria-pressed") == "true":
        follow.click()
    tool(studio, "Drive by hand").click()
    before = page.screenshot(clip=corner)
    drive(studio)
    assert page.screenshot(clip=corner) == before, "the view stays"
    follow.click()
    expect(follow).to_have_attribute("aria-pressed", "true")
    drive(studio)
    wait_until(lambda: page.screenshot(clip=corner) != before, "the view follows", every_s=RARELY_S)
    follow.click()
    turn = pad.get_by_role("button", name="Turn left")
    turn.hover()
    page.mouse.down()
    expect(turn).to_have_attribute("data-held", "true")
    page.mouse.up()
    expect(turn).not_to_have_attribute("data-held", "true")
    tool(studio, "Drive by hand").click()
    expect(pad).to_have_count(0)


def drive(studio: Studio) -> None:
    """Drives backwards for a moment: a wall may be ahead."""
    before = studio.stat("distance")
    studio.page.keyboard.down("s")
    expect(studio.at("teleop").get_by_role("button", name="Back")).to_have_attribute("data-held", "true")
    wait_until(lambda: studio.stat("distance") > before + 0.1, "the robot drives")
    studio.page.keyboard.up("s")
    wait_until(lambda: studio.stat("speed") < 0.02, "the robot stands")
