"""The editors of universes and robots: mouse and keyboard, the text in step, and a run."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING

import pytest
import yaml
from playwright.sync_api import FilePayload, expect

from tests.e2e.accessibility import expect_accessible
from tests.e2e.server import RARELY_S, wait_until
from tests.e2e.view_by_hand import HALF_VIEW

if TYPE_CHECKING:
    from playwright.sync_api import Locator

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(600)]

# The distance of a gizmo's handle from its centre, in heights of the view.
HANDLE = 0.109
# A pyramid in mm, as CAD programs write it: no text, so that only the server has it.
CORNERS = ((0, 0, 0), (60, 0, 0), (0, 60, 0), (0, 0, 60))
MESH_MM = (
    bytes(80)
    + struct.pack("<I", 4)
    + b"".join(
        struct.pack("<12fH", 0, 0, 0, *(part for corner in face for part in CORNERS[corner]), 0)
        for face in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))
    )
)
CRATE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"


def text_of(studio: Studio, path: str) -> str:
    """Returns a text of the project on the server."""
    return file_of(studio, path).decode()


def file_of(studio: Studio, path: str) -> bytes:
    """Returns a file of the project on the server."""
    studio.saved()
    project = studio.page.url.rstrip("/").split("/")[-1]
    answer = studio.page.request.get(f"{studio.server.origin}/api/v1/projects/{project}/files/{path}")
    assert answer.ok, answer.text()
    return answer.body()


def field(panel: Locator, test_id: str, value: str) -> None:
    """Types a number or a word into a field of a panel."""
    panel.get_by_test_id(test_id).fill(value)
    panel.get_by_test_id(test_id).press("Enter")


def new(studio: Studio, kind: str, base: str, name: str) -> None:
    """Creates a universe or a robot through its dialogue."""
    studio.at(f"new-{kind}").click()
    studio.at(f"choice-{base}").click()
    studio.at(f"new-{kind}-name").fill(name)
    studio.at(f"new-{kind}-ok").click()
    expect(studio.at(f"{kind}-view").locator("canvas")).to_be_visible()


def place(studio: Studio, button: str) -> None:
    """Chooses a thing, and places it where its ghost is at first."""
    studio.at(button).click()
    expect(studio.at(button)).to_have_attribute("aria-pressed", "true")
    studio.page.keyboard.press("Enter")
    expect(studio.at(button)).to_have_attribute("aria-pressed", "false")


def change_a_universe(studio: Studio) -> None:
    new(studio, "universe", "empty", "yard")
    place(studio, "place-crate")
    field(studio.at("thing-fields"), "field-x", "2")
    studio.at("universe-view").focus()
    studio.page.keyboard.press("ArrowUp")
    studio.page.keyboard.press("q")
    assert "crate" in text_of(studio, "universes/yard.yaml")
    turned = text_of(studio, "universes/yard.yaml")
    studio.page.keyboard.press("Control+z")
    assert text_of(studio, "universes/yard.yaml") != turned
    studio.at("redo").click()  # the top bar's: the universe is in front
    assert text_of(studio, "universes/yard.yaml") == turned
    a_ceiling_is_switched_on_and_off(studio)
    studio.at("mesh-file").set_input_files(
        files=FilePayload(name="rock.obj", mimeType="text/plain", buffer=CRATE)
    )
    expect(studio.at("universe-view").get_by_test_id("placing")).to_contain_text("rock.obj")
    studio.page.keyboard.press("Enter")
    expect(studio.at("thing-rock")).to_be_visible()
    place(studio, "place-floor")
    studio.page.get_by_role("combobox", name="Texture").click()
    studio.page.get_by_role("option", name="Wood").click()
    things_are_placed_by_mouse(studio)
    wait_until(lambda: is_as_made(text_of(studio, "universes/yard.yaml")), "all of it is in the YAML")


def a_ceiling_is_switched_on_and_off(studio: Studio) -> None:
    """A property of the world itself, which is shown while nothing is selected."""
    studio.at("universe-view").focus()
    studio.page.keyboard.press("Escape")
    before = text_of(studio, "universes/yard.yaml")
    switch = studio.at("field-ceiling")
    switch.check(force=True)  # the switch is drawn over its input
    field(studio.at("world-fields"), "field-ceiling-height", "3")
    inside = yaml.safe_load(text_of(studio, "universes/yard.yaml"))
    assert inside["ceiling"] == {"height": 3}
    switch.uncheck(force=True)
    assert text_of(studio, "universes/yard.yaml") == before


def is_as_made(text: str) -> bool:
    """Returns whether a universe has all changes of the test."""
    yard = yaml.safe_load(text)
    [box] = [model for model in yard["models"] if model["id"] == "box"]
    return (
        "texture: wood" in text
        and box["color"] == "#ff8800"
        and box["size"][0] > 0.6
        and len(yard["actors"][0]["path"]) == 4
        and [robot["id"] for robot in yard["robots"]] == ["robot"]
    )


def things_are_placed_by_mouse(studio: Studio) -> None:
    """From above: a wall is drawn, a box added and dragged; all of it snaps to the grid."""
    view, mouse, keys = studio.at("universe-view"), studio.page.mouse, studio.page.keyboard
    canvas = view.locator("canvas").bounding_box()
    assert canvas
    x, y = canvas["x"] + canvas["width"] / 2, canvas["y"] + canvas["height"] / 2
    view.focus()
    looks_from_above(view)
    keys.press("w")
    expect(studio.at("draw-walls")).to_have_attribute("aria-pressed", "true")
    for corner in (x - 100, x + 100):
        mouse.click(corner, y - 100)
    keys.press("Escape")
    keys.press("Escape")
    expect(studio.at("thing-wall")).to_have_attribute("aria-selected", "true")
    [length] = numbers(studio, "size-0")
    metres = (length - 0.15) / 200  # a pixel

    start, end = (x + 80, y + 100), (x + 180, y + 100)  # beside the rock
    studio.at("place-box").drag_to(
        view, target_position={"x": start[0] - canvas["x"], "y": start[1] - canvas["y"]}
    )
    expect(studio.at("thing-box")).to_have_attribute("aria-selected", "true")
    dropped = numbers(studio, "x", "y")
    view.focus()
    keys.press("Escape")
    drag(studio, start, end)
    expect(studio.at("thing-box")).to_have_attribute("aria-selected", "true")
    carried = numbers(studio, "x", "y")
    # The top, by which it is dragged, is nearer to the eye than the floor.
    assert (carried[0], -100 * metres < carried[1] - dropped[1] < -50 * metres) == (dropped[0], True)
    assert [round(part * 10, 6) % 1 for part in carried] == [0, 0], "on the grid of 0.1 m"

    eye_m = canvas["height"] / 2 * metres / HALF_VIEW
    nearer = eye_m / (eye_m - 0.3)  # the centre, by which it is held, is at that height above the floor
    right, down = start[0] - x + (dropped[1] - carried[1]) / metres, start[1] - y
    middle = (x + right * nearer, y + down * nearer)
    a_box_is_stretched(studio, middle, HANDLE * canvas["height"])
    field(studio.at("thing-fields"), "field-size-0", "0.8")
    studio.at("thing-fields").get_by_role("textbox", name="Colour").fill("#ff8800")
    keys.press("Enter")
    place(studio, "place-person")
    studio.at("add-waypoint").click()
    studio.at("place-robot").click()
    studio.page.get_by_role("menuitem").first.click()
    keys.press("Enter")
    expect(studio.at("thing-robot_2")).to_be_visible()
    view.focus()
    keys.press("Control+z")
    expect(studio.at("thing-robot_2")).to_have_count(0)


def a_box_is_stretched(studio: Studio, at: tuple[float, float], reach: float) -> None:
    """Drags its handle along x, which is up as seen from above, to twice its length; undo reverts it."""
    keys, handle = studio.page.keyboard, (at[0], at[1] - reach)
    before = numbers(studio, "x", "y", "size-0", "size-1", "size-2")
    studio.at("universe-view").focus()
    keys.press("s")
    drag(studio, handle, (at[0], at[1] - 2 * reach))
    x, y, *size = numbers(studio, "x", "y", "size-0", "size-1", "size-2")
    assert 1.5 * before[2] < size[0] < 2.5 * before[2]
    assert (x, y, *size[1:]) == (*before[:2], *before[3:]), "nothing else"
    studio.picture("universe-stretched-light")
    keys.press("Control+z")
    assert numbers(studio, "size-0") == before[2:3]
    keys.press("m")


def looks_from_above(view: Locator) -> None:
    """Repeats until nothing changes any more: meshes that arrive later count, too."""

    def is_settled() -> bool:
        view.press("t")
        before = view.screenshot()
        view.page.wait_for_timeout(500)  # a mesh that arrives later would change the picture
        view.press("t")
        return view.screenshot() == before

    wait_until(is_settled, "all of it is seen from above")


def looks(view: Locator, key: str) -> None:
    """Sets another view, and waits until it is drawn."""
    before = view.screenshot()
    view.press(key)
    wait_until(lambda: view.screenshot() != before, "another view", every_s=RARELY_S)


def numbers(studio: Studio, *fields: str) -> tuple[float, ...]:
    """Returns the values of the selected object's fields."""
    shown = studio.at("thing-fields")
    return tuple(float(shown.get_by_test_id(f"field-{name}").input_value()) for name in fields)


def drag(studio: Studio, start: tuple[float, float], end: tuple[float, float]) -> None:
    mouse = studio.page.mouse
    mouse.move(*start)
    mouse.down()
    mouse.move(*end, steps=5)
    mouse.up()


def change_a_robot(studio: Studio) -> None:
    new(studio, "robot", "template", "mine")
    field(studio.at("robot-fields"), "wheel-radius", "0.06")
    field(studio.at("robot-fields"), "wheel-track", "0.3")
    studio.at("thing-sensor scan").click()
    field(studio.at("part-fields"), "field-z", "0.25")
    field(studio.at("part-fields"), "value-range_max", "5")
    studio.at("robot-view").focus()
    studio.page.keyboard.press("PageUp")
    urdf = text_of(studio, "robots/mine/robot.urdf")
    assert '<origin xyz="0 0 0.255"/>' in urdf
    assert '<sphere radius="0.06"/>' in urdf
    config = text_of(studio, "robots/mine/robot.yaml")
    assert "range_max: 5\n" in config
    assert "track: 0.3\n" in config
    assert "# What may touch the floor" in config
    view = studio.at("robot-view")
    box = view.locator("canvas").bounding_box()
    assert box
    looks(view, "t")
    looks(view, "f")
    arrow = (box["x"] + box["width"] / 2, box["y"] + (0.5 - HANDLE) * box["height"])
    drag(studio, arrow, (arrow[0], arrow[1] - 30))
    ahead = float(studio.at("part-fields").get_by_test_id("field-x").input_value())
    assert 0.01 < ahead < 0.1, "the arrow of its x was drawn"
    place(studio, "add-imu")
    expect(studio.at("thing-sensor imu")).to_have_attribute("aria-selected", "true")
    studio.at("undo").click()
    expect(studio.at("thing-sensor imu")).to_have_count(0)
    let_a_mesh_turn(studio)
    studio.at("robot-text").click()
    studio.page.get_by_text("robot.urdf", exact=True).last.click()
    expect(studio.at("code-editor")).to_have_attribute("data-path", "robots/mine/robot.urdf")
    studio.page.mouse.move(0, 0)  # the menu's choice was above a button with a tooltip
    expect(studio.page.get_by_role("tooltip")).to_have_count(0)


def let_a_mesh_turn(studio: Studio) -> None:
    """A mesh is uploaded, becomes a link with a name, and gets a motor."""
    fields = studio.at("part-fields")
    studio.at("part-mesh-file").set_input_files(
        files=FilePayload(name="cup.stl", mimeType="model/stl", buffer=MESH_MM)
    )
    expect(studio.at("robot-view").get_by_test_id("placing")).to_contain_text("cup.stl")
    studio.page.keyboard.press("Enter")
    expect(studio.at("thing-link cup_link")).to_have_attribute("aria-selected", "true")
    field(fields, "part-name", "holder")
    field(fields, "part-friction", "0.3")
    studio.at("joint").locator("summary").click()
    studio.at("joint-type").click()
    studio.page.get_by_role("option", name="turns between limits").click()
    field(fields, "joint-upper", "45")
    studio.at("joint-motor").check(force=True)
    field(fields, "value-max_rate", "2")
    urdf = text_of(studio, "robots/mine/robot.urdf")
    assert '<mesh filename="meshes/cup.stl" scale="0.001 0.001 0.001"/>' in urdf, "the file counts in mm"
    assert '<child link="holder"/>' in urdf
    assert 'upper="0.785398"' in urdf
    config = text_of(studio, "robots/mine/robot.yaml")
    assert "holder: 0.3" in config
    assert "topic: /cup/command, max_rate: 2" in config
    studio.picture("robot-editor")  # of docs/how-to/make-a-robot.md


def delete_and_bring_back(studio: Studio, name: str) -> None:
    """A robot is deleted with its URDF and its mesh, and all of it is restored."""
    studio.page.get_by_role("button", name=f"More for {name}", exact=True).click()
    studio.menu(f"More for {name}").get_by_role("menuitem", name="Delete").click()
    for file in ("robot.yaml", "robot.urdf", "meshes/cup.stl"):
        expect(studio.at(f"file-robots/{name}/{file}")).to_have_count(0)
    studio.page.get_by_role("button", name="Undo", exact=True).last.click()
    for file in ("robot.yaml", "robot.urdf", "meshes/cup.stl"):
        expect(studio.at(f"file-robots/{name}/{file}")).to_be_visible()
    assert file_of(studio, f"robots/{name}/meshes/cup.stl") == MESH_MM
    assert f'"robot": "{name}"' in text_of(studio, "project.json")


def rename(studio: Studio, name: str, to: str) -> None:
    """The robot's folder gets another name; the project still runs with it."""
    studio.page.get_by_role("button", name=f"More for {name}", exact=True).click()
    studio.menu(f"More for {name}").get_by_role("menuitem", name="Rename").click()
    studio.page.get_by_role("dialog").get_by_role("textbox").fill(to)
    studio.page.keyboard.press("Enter")
    expect(studio.at(f"file-robots/{to}/meshes/cup.stl")).to_be_visible()
    expect(studio.at(f"file-robots/{name}/robot.yaml")).to_have_count(0)
    expect(studio.at("robot-view").locator("canvas")).to_be_visible()


@pytest.mark.long_walk
def test_a_universe_and_a_robot_are_made_by_hand_and_run(studio: Studio):
    studio.new_from("laser_bump_and_go")
    change_a_universe(studio)
    expect_accessible(studio, "light")
    change_a_robot(studio)
    expect_accessible(studio, "light")
    studio.picture("robot-editor-light")
    expect_accessible(studio, "dark")
    studio.picture("robot-editor-dark")
    delete_and_bring_back(studio, "mine")
    rename(studio, "mine", "turner")
    studio.at("robot-editor").get_by_test_id("run-here").click()
    studio.expect_state("application_running")
    studio.end_session()
