"""Where the robot is, by tf."""

from __future__ import annotations

from tests.tree_gardener.nav2_ros import RosNode, Trial, pose
from tree_gardener.nav2.frames import Frames
from tree_gardener.nav2.get_current_pose import GetCurrentPose


def test_frames_are_ports_parameters_or_the_defaults_of_nav2() -> None:
    node = Trial(GetCurrentPose, 'global_frame="own"').tree.nodes[0].behaviour
    frames = Frames(node, RosNode(global_frame="odom", robot_base_frame="body"))
    assert (frames.frame("global_frame"), frames.frame("robot_base_frame")) == ("own", "body")
    assert Frames(node, None).frame("robot_base_frame") == "base_link"


def test_the_nodes_of_a_ros_node_share_a_buffer() -> None:
    ros = RosNode()
    node = Trial(GetCurrentPose).tree.nodes[0].behaviour
    first, second = Frames(node, ros), Frames(node, ros)
    assert len(ros.topics["/tf"]) == 1
    ros.place(2.0)
    for frames in (first, second):
        assert frames.can_transform("map", "base_link")
        assert frames.transformed(pose(1.0, frame="base_link"), "map").pose.position.x == 3.0
    assert first.transformed(pose(1.0, frame="nowhere"), "map") is None
    same = pose(1.0)
    assert Frames(node, None).transformed(same, "map") is same
    assert Frames(node, None).transformed(same, "odom") is None
    assert not Frames(node, None).can_transform("a", "b")
