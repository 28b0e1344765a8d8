"""Messages are taken without an executor."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from rclpy.node import Node
from std_msgs.msg import String

from executor.ros.raw_take import ignore, take, take_with_info

if TYPE_CHECKING:
    from rclpy.context import Context


def test_a_message_is_taken_once(context: Context) -> None:
    node = Node("takes", context=context)
    ear = node.create_subscription(String, "/words", ignore, 10)
    assert take(ear) is None
    mouth = node.create_publisher(String, "/words", 10)
    end_s = time.monotonic() + 30
    while (taken := take_with_info(ear)) is None:
        assert time.monotonic() < end_s
        mouth.publish(String(data="hello"))
        time.sleep(0.01)
    assert taken[0].data == "hello"
    assert taken[1]["source_timestamp"] > 0
    node.destroy_node()
