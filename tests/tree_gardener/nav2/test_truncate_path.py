"""TruncatePath of Nav2."""

from __future__ import annotations

import math

import pytest

from tests.tree_gardener.nav2_ros import Trial, path, xs
from tree_gardener.nav2.truncate_path import TruncatePath

PORTS = 'input_path="{path}" distance="1.0" output_path="{new}"'


def test_the_end_is_cut_and_looks_at_the_goal() -> None:
    points = path(0.0, 1.0, 2.0, 2.5, 3.0)
    points.poses[-1].pose.position.y = 0.1
    trial = Trial(TruncatePath, PORTS, path=points)
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [0.0, 1.0, 2.0]
    turn = trial["new"].poses[-1].pose.orientation
    assert 2 * math.atan2(turn.z, turn.w) == pytest.approx(math.atan2(0.1, 1.0))
    assert points.poses[2].pose.orientation.z == 0.0


def test_two_poses_stay_and_an_empty_path_is_written_as_it_is() -> None:
    trial = Trial(TruncatePath, PORTS, path=path(2.8, 2.9, 3.0))
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [2.8, 2.9]
    trial["path"] = path()
    assert trial.tick() == "S"
    assert xs(trial["new"]) == []
    assert Trial(TruncatePath, PORTS).tick() == "S"
