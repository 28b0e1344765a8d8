"""Projects in JdeRobot's style, dropped onto the start page as zips, drive."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from playwright.sync_api import expect

from tests.budget import count
from tests.e2e.server import wait_until
from tests.e2e.test_hands_projects import drop, report, zipped
from tests.fakes.jderobot_projects import write_follower, write_wanderer

if TYPE_CHECKING:
    from pathlib import Path

    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.simulation, pytest.mark.timeout(600)]

FAR_M = 1.5
UNIVERSES = {write_wanderer: "Walled room", write_follower: "Person in green"}


@pytest.mark.parametrize("write", list(UNIVERSES)[: count("e2e_imported_projects")], ids=lambda w: w.__name__)
def test_an_imported_project_drives_in_the_universe_that_its_topics_ask_for(
    studio: Studio, tmp_path: Path, write
) -> None:
    folder = write(tmp_path / write.__name__)
    files = {str(path.relative_to(tmp_path)): path.read_bytes() for path in folder.rglob("*.*")}
    drop(studio, f"{folder.name}.zip", zipped(files))
    expect(studio.at("import-reason")).to_contain_text("It is proposed because the actions")
    report(studio, f"{folder.name}.zip")
    expect(studio.at("canvas")).to_be_visible()
    studio.run()
    observer = studio.observe()
    wait_until(lambda: observer.distance_travelled("robot") > FAR_M, "the imported robot drives")
    assert observer.of("snapshot")[0]["data"]["universe"] == UNIVERSES[write]
    assert studio.stat("collisions") == 0
    expect(studio.at("console")).not_to_contain_text("Nothing arrives")
    studio.picture(f"imported-{folder.name}")
    observer.close()
