"""Poses, paths and maps as messages and back."""

from __future__ import annotations

import math

import pytest

from executor.navigation.forms import (
    FrameError,
    between,
    duration,
    grid_message,
    path_message,
    placed,
    pose_of,
    seconds_of,
    stamped,
)
from executor.navigation.grid import Grid

ROBOT, ODOMETRY = (2.0, 1.0, math.pi / 2), (0.5, 0.0, 0.0)


def test_the_frame_of_the_odometry_is_placed_so_that_both_poses_of_the_robot_agree() -> None:
    assert placed(between(ROBOT, ODOMETRY), ODOMETRY) == pytest.approx(ROBOT)


@pytest.mark.parametrize(
    ("frame", "expected"),
    [
        ("map", (1.0, 0.0, 0.5)),
        ("", (1.0, 0.0, 0.5)),
        ("odom", (2.0, 1.5, math.pi / 2 + 0.5)),
        ("base_link", (2.0, 2.0, math.pi / 2 + 0.5)),
    ],
)
def test_a_pose_is_read_in_its_frame(frame: str, expected: tuple[float, float, float]) -> None:
    message = stamped((1.0, 0.0, 0.5), 3.25)
    assert (message.header.stamp.sec, message.header.stamp.nanosec) == (3, 250_000_000)
    message.header.frame_id = frame
    assert pose_of(message, ROBOT, ODOMETRY) == pytest.approx(expected)


def test_an_unknown_frame_is_an_error_that_says_which_are_known() -> None:
    message = stamped((1.0, 0.0, 0.0), 0.0)
    message.header.frame_id = "mars"
    with pytest.raises(FrameError, match=r"'mars' is not known; give the pose in map"):
        pose_of(message, ROBOT, ODOMETRY)


def test_the_poses_of_a_path_look_along_it_and_the_last_one_has_the_heading() -> None:
    path = path_message([(0, 0), (1, 0), (1, 1)], -1.0, 2.0)
    yaws = [pose_of(each, ROBOT, ODOMETRY)[2] for each in path.poses]
    assert yaws == pytest.approx([0.0, math.pi / 2, -1.0])
    assert path.header.frame_id == "map"
    assert path_message([], None, 0.0).poses == []


def test_a_map_has_its_cells_row_by_row() -> None:
    grid = Grid.empty((-1, 2), (2, 4), 1.0)
    grid.occupied[1, 2] = True
    message = grid_message(grid, 1.0)
    assert (message.info.width, message.info.height) == (3, 2)
    assert list(message.data) == [0, 0, 0, 0, 0, 100]
    assert (message.info.origin.position.x, message.info.origin.position.y) == (-1.0, 2.0)


def test_durations_survive() -> None:
    assert seconds_of(duration(2.75)) == 2.75
