"""GetPoseFromPath of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import Trial, path
from tree_gardener.nav2.get_pose_from_path import GetPoseFromPath


@pytest.mark.parametrize(("index", "expected"), [(0, 1.0), (2, 3.0), (-1, 3.0), (-3, 1.0)])
def test_the_pose_is_written_with_a_frame(index: int, expected: float) -> None:
    points = path(1.0, 2.0, 3.0, frame="odom")
    points.poses[0].header.frame_id = ""
    trial = Trial(GetPoseFromPath, f'path="{{path}}" index="{index}" pose="{{pose}}"', path=points)
    assert trial.tick() == "S"
    assert (trial["pose"].pose.position.x, trial["pose"].header.frame_id) == (expected, "odom")


@pytest.mark.parametrize("index", [3, -4])
def test_no_such_pose_fails(index: int) -> None:
    ports = f'path="{{path}}" index="{index}" pose="{{pose}}"'
    assert Trial(GetPoseFromPath, ports, path=path(1.0, 2.0, 3.0)).tick() == "F"
    assert Trial(GetPoseFromPath, ports).tick() == "F"
