"""PathLongerOnApproach of Nav2."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_ros import Trial, path
from tree_gardener.nav2.path_longer_on_approach import PathLongerOnApproach

PORTS = 'path="{path}" prox_len="3.0" length_factor="2.0"'


def test_a_much_longer_path_near_the_goal_ticks_the_child_once() -> None:
    trial = Trial(PathLongerOnApproach, PORTS, children="F", path=path(0.0, 1.0))
    assert trial.tick() == "S"
    trial["path"] = path(0.0, -1.0, 1.0)
    assert trial.tick() == "F"
    assert trial.tick() == "S"
    assert trial.child_ticks == 1


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ((0.0, 1.0), (0.0, 0.5, 1.0)),  # not longer
        ((0.0, 3.0), (0.0, -9.0, 3.0)),  # not near
        ((0.0, 1.0), (-9.0, 1.0)),  # as many poses
        ((0.0, 1.0), (0.0, -1.0, 2.0)),  # another goal
        ((), (0.0, -1.0, 1.0)),  # no old path
    ],
)
def test_other_paths_succeed(old: tuple[float, ...], new: tuple[float, ...]) -> None:
    trial = Trial(PathLongerOnApproach, PORTS, children="F", path=path(*old))
    assert trial.tick() == "S"
    trial["path"] = path(*new)
    assert trial.tick() == "S"


def test_while_the_child_runs_or_is_skipped_the_old_path_is_kept() -> None:
    trial = Trial(PathLongerOnApproach, PORTS, children="RKS", path=path(0.0, 1.0))
    trial.tick()
    trial["path"] = path(0.0, -1.0, 1.0)
    assert trial.tick() + trial.tick() + trial.tick() == "RKS"
    assert Trial(PathLongerOnApproach, children="F").tick() == "S"
