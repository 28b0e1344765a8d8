"""The publishers, subscriptions and parameters that a tree opened are closed after it."""

from __future__ import annotations

from typing import Any

import pytest

from tests.tree_gardener.ros_graph import graph
from tree_gardener.ros_entities import OpenedSince

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")


def entities(node: Any) -> list[int]:
    kinds = (node.publishers, node.subscriptions, node.clients, node.services, node.timers, node.waitables)
    return [len(list(kind)) for kind in kinds]


def test_only_what_was_opened_since_is_closed() -> None:
    from btcpp_ros2_interfaces.action import ExecuteTree
    from rclpy.action import ActionClient
    from std_msgs.msg import String
    from std_srvs.srv import Trigger

    with graph() as made:
        node = made.other
        node.create_publisher(String, "before", 1)
        node.declare_parameter("before", 1)
        before = entities(node)
        opened = OpenedSince(node)
        node.create_publisher(String, "later", 1)
        node.create_subscription(String, "later", lambda _: None, 1)
        node.create_timer(1.0, lambda: None)
        node.create_client(Trigger, "later")
        node.create_service(Trigger, "later", lambda _request, response: response)
        ActionClient(node, ExecuteTree, "later")
        node.declare_parameter("later", 2)
        assert entities(node) != before
        opened.close()
        assert entities(node) == before
        assert node.has_parameter("before")
        assert not node.has_parameter("later")
