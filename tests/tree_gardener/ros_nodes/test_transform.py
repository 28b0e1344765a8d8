"""Transforms of /tf as a node."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage

from tree_gardener import Status
from tree_gardener.ros_nodes.frames import frames_of
from tree_gardener.ros_nodes.transform import TfLookup

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

LOOKUP = "<TfLookup target_frame='map' source_frame='base' "


def send(ros: Graph) -> None:
    publisher = ros.other.create_publisher(TFMessage, "/tf", 10)
    ros.spin(lambda: publisher.get_subscription_count() == 1)
    move = TransformStamped()
    move.header.frame_id, move.child_frame_id = "map", "base"
    move.header.stamp.sec = 3
    move.transform.translation.x = 1.5
    move.transform.rotation.z = move.transform.rotation.w = math.sqrt(0.5)
    publisher.publish(TFMessage(transforms=[move]))


def test_the_node_waits_for_the_transform_and_writes_it(ros: Graph) -> None:
    assert TfLookup.__doc__
    ros.load(f"{LOOKUP} x='{{x}}' yaw='{{yaw}}' pose='{{pose}}'/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    send(ros)
    assert ros.run() is Status.SUCCESS
    assert ros["x"] == 1.5
    assert ros["yaw"] == pytest.approx(math.pi / 2)
    assert ros["pose"].header.frame_id == "map"
    assert ros["pose"].header.stamp.sec == 3
    assert ros["pose"].pose.position.x == 1.5


def test_it_gives_up_and_names_the_frame_that_is_missing(ros: Graph) -> None:
    ros.load(f"{LOOKUP} timeout='100' error='{{why}}'/>")
    assert ros.tree.tick_exactly_once() is Status.RUNNING
    ros.clock.advance(0.2)
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert ros["why"] == "the frame map was never named on /tf"


def test_a_transform_that_is_too_old_does_not_count(ros: Graph) -> None:
    ros.load(f"{LOOKUP} timeout='0' max_age='1000' error='{{why}}'/>")
    send(ros)
    ros.spin(lambda: frames_of(ros.tree_node).has("base"))
    assert ros.tree.tick_exactly_once() is Status.FAILURE
    assert "s old" in ros["why"]
