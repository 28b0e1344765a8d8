"""ConcatenatePaths of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial, path, xs
from tree_gardener.nav2.concatenate_paths import ConcatenatePaths

PORTS = 'input_path1="{a}" input_path2="{b}" output_path="{new}"'


def test_the_second_path_follows_the_first() -> None:
    trial = Trial(ConcatenatePaths, PORTS, a=path(1.0, frame="a"), b=path(2.0, 3.0, frame="b"))
    assert trial.tick() == "S"
    assert xs(trial["new"]) == [1.0, 2.0, 3.0]
    assert trial["new"].header.frame_id == "a"


def test_an_empty_header_gives_way() -> None:
    trial = Trial(ConcatenatePaths, PORTS, a=path(frame=""), b=path(2.0, frame="b"))
    assert trial.tick() == "S"
    assert trial["new"].header.frame_id == "b"


def test_two_empty_paths_fail() -> None:
    assert Trial(ConcatenatePaths, PORTS).tick() == "F"
    assert Trial(ConcatenatePaths, PORTS, a=path(), b=path()).tick() == "F"
