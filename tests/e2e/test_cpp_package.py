"""The package for BehaviorTree.CPP, the palette and the XML Schema are downloaded from the dialogue."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from tests.e2e.studio import Studio

pytestmark = [pytest.mark.e2e, pytest.mark.timeout(300)]


def test_a_package_of_cpp_is_downloaded(studio: Studio) -> None:
    studio.new_from("laser_bump_and_go")
    studio.at("open-take-away").click()
    studio.at("download-cpp").scroll_into_view_if_needed()
    studio.picture("take-away-cpp")
    with zipfile.ZipFile(io.BytesIO(downloaded(studio, "download-cpp"))) as package:
        names = {path.partition("/")[2] for path in package.namelist()}
        [folder] = {path.partition("/")[0] for path in package.namelist()}
        register = package.read(f"{folder}/src/register_nodes.cpp").decode()
    assert {"package.xml", "CMakeLists.txt", "README.md", "src/run_tree.cpp"} <= names
    assert {f"trees/{folder}.xml", f"models/{folder}.xml"} <= names
    assert f"include/{folder}/nodes/check_obstacle.hpp" in names
    assert "src/nodes/check_obstacle.cpp" in names
    assert f'factory.registerNodeType<{folder}::Forward>("Forward");' in register
    studio.at("more-downloads").locator("summary").press("Enter")
    assert b'<Condition ID="CheckObstacle">' in downloaded(studio, "download-models")
    assert b'name="CheckObstacle"' in downloaded(studio, "download-schema")


def downloaded(studio: Studio, button: str) -> bytes:
    with studio.page.expect_download() as download:
        studio.at(button).click()
    return Path(download.value.path()).read_bytes()
