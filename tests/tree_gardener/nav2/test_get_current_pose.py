"""GetCurrentPose of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial
from tree_gardener.nav2.get_current_pose import GetCurrentPose


def test_the_pose_is_written_when_it_is_known() -> None:
    ros = RosNode()
    trial = Trial(GetCurrentPose, 'current_pose="{here}"', ros=ros)
    assert trial.tick() == "F"
    ros.place(2.0, 3.0)
    assert trial.tick() == "S"
    here = trial["here"]
    assert (here.pose.position.x, here.pose.position.y, here.header.frame_id) == (2.0, 3.0, "map")
    assert here.pose.orientation.w == 1.0
