"""ArePosesNear of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial, pose
from tree_gardener.nav2.are_poses_near import ArePosesNear

PORTS = 'ref_pose="{a}" target_pose="{b}" tolerance="0.5"'


def test_poses_of_one_frame_are_compared_as_they_are() -> None:
    assert Trial(ArePosesNear, PORTS, a=pose(0.0), b=pose(0.3, 0.4)).tick() == "S"
    assert Trial(ArePosesNear, PORTS, a=pose(0.0), b=pose(0.6)).tick() == "F"
    assert Trial(ArePosesNear, PORTS).tick() == "F"


def test_poses_of_two_frames_are_transformed() -> None:
    ros = RosNode()
    trial = Trial(ArePosesNear, PORTS, ros=ros, a=pose(2.0), b=pose(0.0, frame="base_link"))
    assert trial.tick() == "F"
    ros.place(2.0)
    assert trial.tick() == "S"
    ros.place(9.0)
    assert trial.tick() == "F"
    assert Trial(ArePosesNear, PORTS, a=pose(2.0), b=pose(0.0, frame="base_link")).tick() == "F"
