"""A robot with its links, drive and sensors."""

from __future__ import annotations

import pytest

from executor.robots import robot_ids
from executor.robots.config import RobotError, load_robot


@pytest.mark.parametrize("robot_id", robot_ids())
def test_every_built_in_robot_is_read(robot_id: str) -> None:
    robot = load_robot(robot_id)
    names = [lidar.link for lidar in robot.lidars] + [camera.link for camera in robot.cameras]
    assert set(names) <= set(robot.urdf.links)


def test_an_unknown_one_is_refused() -> None:
    with pytest.raises(RobotError):
        load_robot("no_such_robot")
