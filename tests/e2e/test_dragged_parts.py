"""A xacro robot and an SDF world are dragged in as they lie on the disk, and *bump and go* drives there."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.e2e.accessibility import expect_no_findings
from tests.e2e.server import RARELY_S, wait_until
from tests.executor.robots.importing.carts import BODY, CASTOR, robot, wheel

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from playwright.sync_api import ViewportSize

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

LIDAR = """<gazebo reference="base_link"><sensor name="laser" type="gpu_lidar"><update_rate>10</update_rate>
<topic>scan</topic><pose>0 0 0.25 0 0 0</pose><lidar><scan><horizontal><samples>360</samples>
<min_angle>-3.14159</min_angle><max_angle>3.14159</max_angle></horizontal></scan>
<range><min>0.1</min><max>8</max></range></lidar></sensor>
<sensor name="place" type="gps"/></gazebo>"""
TOP = """<xacro:arg name="x" default="0.09"/><xacro:include filename="$(find cart)/urdf/wheels.xacro"/>"""
SPACE = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
CART = {
    "cart/package.xml": "<package><name>cart</name></package>",
    "cart/urdf/cart.urdf.xacro": robot(TOP, BODY, CASTOR.format(x="$(arg x)"), LIDAR).replace(
        "<robot", f"<robot {SPACE}", 1
    ),
    "cart/urdf/wheels.xacro": f"<robot {SPACE}>{wheel('left', 0, 0.1)}{wheel('right', 0, -0.1)}</robot>",
}


def box(name: str, pose: str, size: str) -> str:
    """Returns a standing box of an SDF world."""
    shape = f"<geometry><box><size>{size}</size></box></geometry>"
    return (
        f'<model name="{name}"><static>true</static><pose>{pose} 0.25 0 0 0</pose><link name="l">'
        f'<collision name="c">{shape}</collision><visual name="v">{shape}</visual></link></model>'
    )


WALLS = "".join(
    box(f"wall_{number}", pose, size)
    for number, (pose, size) in enumerate(
        [("3 0", "0.1 6 0.5"), ("-3 0", "0.1 6 0.5"), ("0 3", "6 0.1 0.5"), ("0 -3", "6 0.1 0.5")]
    )
)
YARD = {
    "yard/worlds/yard.sdf": f'<sdf version="1.9"><world name="yard">{WALLS}'
    "<include><uri>model://crate</uri><pose>2 1.5 0 0 0 0</pose></include></world></sdf>",
    "yard/models/crate/model.config": "<model><name>crate</name><sdf>model.sdf</sdf></model>",
    "yard/models/crate/model.sdf": f'<sdf version="1.9">{box("crate", "0 0", "0.4 0.4 0.5")}</sdf>',
}
NARROW: ViewportSize = {"width": 400, "height": 800}
WIDE: ViewportSize = {"width": 1440, "height": 900}


def written(folder: Path, files: Mapping[str, str]) -> Path:
    """Writes files; returns the folder that all of them are in."""
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder / next(iter(files)).split("/", maxsplit=1)[0]


def drag(studio: Studio, path: Path) -> None:
    """Drags a file or folder of the disk onto the page, as the desktop does."""
    browser = studio.page.context.new_cdp_session(studio.page)
    data = {"items": [], "files": [str(path)], "dragOperationsMask": 1}

    def send(kind: str) -> None:
        browser.send("Input.dispatchDragEvent", {"type": kind, "x": 300, "y": 300, "data": data})

    send("dragEnter")
    send("dragOver")
    expect(studio.page.get_by_text("Drop a robot, a world, a map or a log")).to_be_visible()
    send("dragOver")  # over what has come up meanwhile
    send("drop")
    browser.detach()


def looks_right(studio: Studio, name: str) -> None:
    """The dialogue is judged in both themes, and fits a narrow window."""
    page = studio.page
    for scheme in ("dark", "light"):
        page.evaluate("s => document.documentElement.setAttribute('data-mantine-color-scheme', s)", scheme)
        expect_no_findings(page, f"{name}, {scheme}")
        studio.picture(f"{name}-{scheme}")
    page.set_viewport_size(NARROW)
    dialog = page.get_by_role("dialog")
    assert dialog.evaluate("box => box.scrollWidth - box.clientWidth") <= 0, f"{name} is too wide"
    studio.picture(f"{name}-narrow")
    page.set_viewport_size(WIDE)


def revisions(studio: Studio) -> int:
    """Returns the number of the project's revisions."""
    project = studio.page.url.split("?")[0].rstrip("/").split("/")[-1]
    answer = studio.page.request.get(f"{studio.server.origin}/api/v1/projects/{project}").json()
    return int(answer["revision"])


def test_a_robot_and_a_world_are_dragged_in_and_driven_and_one_undo_takes_each_back(
    studio: Studio, tmp_path: Path
) -> None:
    page = studio.page
    studio.new_from("laser_bump_and_go")
    studio.saved()
    before = revisions(studio)

    drag(studio, written(tmp_path, CART))
    expect(studio.at("import-name")).to_have_value("cart")
    expect(page.get_by_text("1 argument", exact=True)).to_be_visible()
    looks_right(studio, "import-options")
    expect(studio.at("import-name")).to_be_focused()
    page.keyboard.press("Enter")
    expect(studio.at("test-drive").get_by_role("listitem")).to_have_count(2)
    expect(studio.at("test-drive").locator("[data-fits=true]")).to_have_count(2)
    report = studio.at("part-report")
    expect(report).to_contain_text("cart.urdf.xacro:")
    expect(report).to_contain_text("GPS")
    looks_right(studio, "import-report-robot")
    expect(studio.at("import-open")).to_be_focused()
    page.keyboard.press("Enter")
    expect(studio.at("robot-editor")).to_be_visible()
    assert revisions(studio) == before + 1

    drag(studio, written(tmp_path, YARD))
    expect(studio.at("import-name")).to_have_value("yard")
    studio.at("import-take").click()
    expect(studio.at("part-report")).to_contain_text("5 things came in.")
    expect(studio.at("part-report")).to_contain_text("Nothing was left out.")
    looks_right(studio, "import-report-world")
    studio.at("import-open").click()
    expect(studio.at("universe-editor")).to_be_visible()
    assert revisions(studio) == before + 2

    studio.run()
    observer = studio.observe()
    wait_until(lambda: observer.distance_travelled("robot") > 0.5, "the robot moves", every_s=RARELY_S)
    observer.close()
    studio.end_session()

    studio.at("universe-view").focus()
    page.keyboard.press("Control+z")
    expect(studio.at("file-universes/yard.yaml")).to_have_count(0)
    expect(studio.at("universe-editor")).to_have_count(0)
    studio.saved()
    assert revisions(studio) == before + 3
    page.get_by_role("button", name="Bring it back").click()
    expect(studio.at("file-universes/yard.yaml")).to_be_visible()
