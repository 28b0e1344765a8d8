"""Distances between poses and along paths."""

from __future__ import annotations

import math

import pytest
from geometry_msgs.msg import Quaternion

from tests.tree_gardener.nav2_ros import path, pose, xs
from tree_gardener.nav2 import geometry


def test_lengths_and_places_along_a_path() -> None:
    poses = path(0.0, 1.0, 3.0, 6.0).poses
    assert geometry.distance(pose(0.0), pose(3.0, 4.0)) == 5.0
    assert geometry.path_length(poses) == 6.0
    assert geometry.path_length(poses, 2) == 3.0
    assert geometry.path_length(poses, 3) == geometry.path_length([]) == 0.0
    assert [geometry.first_beyond(poses, 0, way) for way in (0.5, 1.0, 2.9, 6.0)] == [1, 2, 2, 4]
    assert geometry.first_beyond(poses, 1, 0.0) == 2


def test_of_several_nearest_the_last_counts() -> None:
    assert geometry.nearest(0, 4, [2, 1, 1, 3].__getitem__) == 2
    assert geometry.nearest(2, 2, [].__getitem__) == 2


def test_turns_are_the_shortest() -> None:
    ahead = Quaternion(x=0.0, y=0.0, z=0.0, w=1.0)
    for angle in (0.0, 1.0, -1.0, math.pi, 5.0):
        turn = Quaternion(x=0.0, y=0.0, z=math.sin(angle / 2), w=math.cos(angle / 2))
        assert geometry.turn_between(ahead, turn) == pytest.approx(abs(math.remainder(angle, math.tau)))
    assert geometry.turn_between(ahead, Quaternion(w=0.0)) == 0.0


def test_a_copy_has_changes_of_its_own() -> None:
    one = path(0.0)
    other = geometry.copied(one, poses=[])
    assert (xs(one), xs(other), other.header) == ([0.0], [], one.header)
