"""The committed schema of `robot.yaml`, and the editor's template for robots."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

from executor.robots import load_robot
from executor.robots.reference import FOR_THE_EDITOR, PAGE, schema

if TYPE_CHECKING:
    from pathlib import Path

TEMPLATE = FOR_THE_EDITOR.parents[1] / "model" / "robot" / "template"


def test_the_schema_is_up_to_date():
    for path in (PAGE, FOR_THE_EDITOR):
        assert path.read_text(encoding="utf-8") == schema(), "run: python -m executor.robots.reference"


def test_the_editors_template_is_a_robot_that_drives_and_sees(tmp_path: Path):
    shutil.copytree(TEMPLATE, tmp_path / "robots" / "mine")
    robot = load_robot("mine", tmp_path)
    assert robot.drive.left
    assert robot.drive.right
    assert [lidar.topic for lidar in robot.lidars] == ["/scan"]
    assert [camera.topic for camera in robot.cameras] == ["/camera/image_raw"]
