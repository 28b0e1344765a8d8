"""DistanceTraveled of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.distance_traveled import DistanceTraveled


def test_it_succeeds_after_each_distance() -> None:
    ros = RosNode()
    trial = Trial(DistanceTraveled, 'distance="1.0"', ros=ros)
    ros.place(0.0)
    assert trial.tick() + trial.again() == "FF"
    ros.place(0.0, 1.0)
    assert trial.again() + trial.again() == "SF"
    ros.place(0.0, 2.5)
    assert trial.tick() + trial.again() == "FF"


def test_it_fails_without_a_pose_and_begins_with_the_first_one() -> None:
    assert Trial(DistanceTraveled).tick() == "F"
    ros = RosNode()
    trial = Trial(DistanceTraveled, ros=ros)
    assert trial.tick() + trial.again() == "FF"
    ros.place(5.0)
    assert trial.again() == "F"
    ros.place(6.0)
    assert trial.again() == "S"
