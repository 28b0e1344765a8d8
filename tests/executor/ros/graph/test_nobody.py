"""Topics that nobody publishes and services that nobody serves are found, with what is published instead."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.context import Context


@pytest.fixture
def nodes(context: Context) -> Iterator[tuple[Any, Any]]:
    from rclpy.node import Node

    world, application = Node("world", context=context), Node("bt_application", context=context)
    yield world, application
    application.destroy_node()
    world.destroy_node()


def topics(node: Any) -> list[tuple[str, str, dict[str, str]]]:
    from executor.ros.graph.nobody import topics_of_nobody

    return [(found.topic, found.code, found.values) for found in topics_of_nobody(node, "world")]


def test_the_topics_of_the_same_type_are_named_the_nearest_first(nodes: Any) -> None:
    from geometry_msgs.msg import Twist
    from sensor_msgs.msg import Image

    world, application = nodes
    for name in ("/depth", "/camera/image_raw", "/a", "/b"):
        world.create_publisher(Image, name, 10)
    application.create_subscription(Image, "/cam_f1_left/image_raw", print, 10)
    world.create_subscription(Twist, "/cmd_vel", print, 10)  # the world waits for commands
    [(topic, code, values)] = topics(application)
    assert (topic, code, values["kind"]) == ("/cam_f1_left/image_raw", "elsewhere", "sensor_msgs/msg/Image")
    assert values["others"].split(", ")[0] == "/camera/image_raw"
    assert len(values["others"].split(", ")) == 3


def test_a_type_that_nobody_publishes(nodes: Any) -> None:
    from sensor_msgs.msg import Joy

    _, application = nodes
    application.create_subscription(Joy, "/joy", print, 10)
    assert topics(application) == [("/joy", "unpublished", {"kind": "sensor_msgs/msg/Joy"})]


def test_a_clock_and_hidden_nodes_need_no_publisher(context: Context, nodes: Any) -> None:
    from rclpy.node import Node
    from rosgraph_msgs.msg import Clock

    _, application = nodes
    hidden = Node("_recorder", context=context)
    application.create_subscription(Clock, "/clock", print, 10)
    hidden.create_subscription(Clock, "/mine", print, 10)
    assert topics(application) == []
    hidden.destroy_node()


def test_services_and_actions_that_nobody_serves(nodes: Any) -> None:
    from nav2_msgs.action import NavigateToPose
    from rclpy.action import ActionClient, ActionServer
    from std_srvs.srv import Trigger

    from executor.ros.graph.nobody import unserved

    world, application = nodes
    served = world.create_service(Trigger, "/open", print)
    for name in ("/open", "/close"):
        application.create_client(Trigger, name)
    client = ActionClient(application, NavigateToPose, "/navigate_to_pose")
    found = sorted(
        (each.topic, each.values["what"], each.values["kind"]) for each in unserved(world, "world")
    )
    assert found == [
        ("/close", "service", "std_srvs/srv/Trigger"),
        ("/navigate_to_pose", "action", "nav2_msgs/action/NavigateToPose"),
    ]
    server = ActionServer(world, NavigateToPose, "/navigate_to_pose", print)
    world.create_service(Trigger, "/close", print)
    assert list(unserved(world, "world")) == []
    server.destroy()
    client.destroy()
    world.destroy_service(served)
