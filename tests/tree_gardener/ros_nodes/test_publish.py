"""Publishing as a node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from geometry_msgs.msg import TwistStamped
from rclpy.qos import DurabilityPolicy, ReliabilityPolicy

from tree_gardener import Status, TickError
from tree_gardener.ros_nodes.publish import quality

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

PUBLISH = "<RosPublish topic_name='cmd' topic_type='geometry_msgs/msg/TwistStamped' "


def test_each_tick_publishes_the_fields(ros: Graph) -> None:
    heard: list[Any] = []
    ros.other.create_subscription(TwistStamped, "cmd", heard.append, 10)
    ros.clock.advance(12.5)
    ros.load(f"{PUBLISH} message__twist__linear__x='{{v}}' message__header__stamp='now'/>", v=0.25)
    publisher = ros.tree.nodes[0].behaviour._publisher
    ros.spin(lambda: publisher.get_subscription_count() == 1)
    assert ros.tree.tick_exactly_once() is Status.SUCCESS
    ros.tree.blackboard["v"] = 0.5
    assert ros.tree.tick_exactly_once() is Status.SUCCESS
    ros.spin(lambda: len(heard) == 2)
    assert [each.twist.linear.x for each in heard] == [0.25, 0.5]
    assert (heard[0].header.stamp.sec, heard[0].header.stamp.nanosec) == (12, 500_000_000)


def test_a_latched_message_reaches_those_who_come_later(ros: Graph) -> None:
    assert ros.run(f"{PUBLISH} latched='true' message__header__frame_id='map'/>") is Status.SUCCESS
    heard: list[Any] = []
    ros.other.create_subscription(TwistStamped, "cmd", heard.append, quality(latched=True))
    ros.spin(lambda: bool(heard))
    assert heard[0].header.frame_id == "map"


def test_a_value_that_does_not_suit_its_field_is_found_before_the_first_tick(ros: Graph) -> None:
    with pytest.raises(TickError, match=r"message__twist__linear__x.*is a number"):
        ros.load(f"{PUBLISH} message__twist__linear__x='fast'/>")


def test_qualities_of_service() -> None:
    assert quality(sensor=True).reliability is ReliabilityPolicy.BEST_EFFORT
    assert quality(latched=True).durability is DurabilityPolicy.TRANSIENT_LOCAL
