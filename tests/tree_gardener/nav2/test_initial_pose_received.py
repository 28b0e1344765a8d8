"""InitialPoseReceived of Nav2."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import Trial
from tree_gardener.nav2.initial_pose_received import InitialPoseReceived


def test_it_reads_the_port_or_the_entry() -> None:
    assert Trial(InitialPoseReceived).tick() == "F"
    assert Trial(InitialPoseReceived, initial_pose_received=True).tick() == "S"
    port = 'initial_pose_received="{is_there}"'
    assert Trial(InitialPoseReceived, port, is_there=True).tick() == "S"
    assert Trial(InitialPoseReceived, port, is_there=False, initial_pose_received=True).tick() == "F"
    assert Trial(InitialPoseReceived, 'initial_pose_received="true"').tick() == "S"
