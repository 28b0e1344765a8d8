"""DistanceController of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.distance_controller import DistanceController


def test_the_child_is_ticked_at_the_start_and_after_each_distance() -> None:
    ros = RosNode()
    trial = Trial(DistanceController, 'distance="1.0"', children="S", ros=ros)
    ros.place(0.0)
    assert trial.tick() == "S"
    assert trial.again() == "R"
    ros.place(0.9)
    assert trial.again() == "R"
    ros.place(1.0)
    assert trial.again() == "S"
    ros.place(1.9)
    assert trial.again() == "R"
    assert trial.child_ticks == 2


def test_a_running_child_is_ticked_at_every_tick() -> None:
    ros = RosNode()
    trial = Trial(DistanceController, children="RRF", ros=ros)
    ros.place(0.0)
    assert trial.tick() + trial.tick() + trial.tick() == "RRF"


def test_it_fails_while_the_pose_is_not_known_and_frames_are_ports_or_parameters() -> None:
    assert Trial(DistanceController, children="S").tick() == "F"
    ros = RosNode(global_frame="odom")
    trial = Trial(DistanceController, 'robot_base_frame="base"', children="S", ros=ros)
    ros.place(0.0)
    assert trial.tick() == "F"
    assert trial.child_ticks == 0
    ros.place(0.0, frame="odom", base="base")
    assert trial.tick() == "S"
