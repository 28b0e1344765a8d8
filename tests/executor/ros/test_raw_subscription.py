"""Raw subscriptions to publishers of each quality of service."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import pytest
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message
from std_msgs.msg import String

from executor.ros.raw_subscription import subscribe_raw
from executor.ros.raw_take import take

if TYPE_CHECKING:
    from rclpy.context import Context


@pytest.mark.parametrize("reliability", [ReliabilityPolicy.RELIABLE, ReliabilityPolicy.BEST_EFFORT])
@pytest.mark.parametrize("is_latched", [True, False])
def test_messages_of_each_kind_of_publisher_are_taken(
    context: Context, reliability: ReliabilityPolicy, *, is_latched: bool
) -> None:
    if is_latched and reliability is ReliabilityPolicy.BEST_EFFORT:
        reliability = ReliabilityPolicy.RELIABLE  # ROS latches reliable topics alone
    node = Node("raw", context=context)
    durability = DurabilityPolicy.TRANSIENT_LOCAL if is_latched else DurabilityPolicy.VOLATILE
    qos = QoSProfile(depth=1, reliability=reliability, durability=durability)
    publisher = node.create_publisher(String, "/raw", qos)
    if is_latched:
        publisher.publish(String(data="before"))
    subscription = subscribe_raw(node, "/raw", String)
    if not is_latched:
        publisher.publish(String(data="before"))
    end_s = time.monotonic() + 20
    while (data := take(subscription)) is None:
        assert time.monotonic() < end_s
        time.sleep(0.005)
    assert deserialize_message(data, String).data == "before"
    node.destroy_node()
