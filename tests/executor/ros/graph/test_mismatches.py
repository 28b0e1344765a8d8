"""Topics whose ends do not match: reported once, with both ends, the reason and a hint."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from msgspec import to_builtins

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rclpy.context import Context


@pytest.fixture
def graph(context: Context) -> Iterator[tuple[Any, Any, list[dict[str, Any]], Any]]:
    from rclpy.node import Node

    from executor.ros.graph.mismatches import Mismatches

    world, application = Node("world", context=context), Node("bt_application", context=context)
    told: list[dict[str, Any]] = []
    yield world, application, told, Mismatches(world, lambda message: told.append(to_builtins(message)))
    application.destroy_node()
    world.destroy_node()


def test_best_effort_published_and_reliable_requested(graph: Any) -> None:
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import LaserScan

    world, application, told, mismatches = graph
    application.create_publisher(LaserScan, "/mine", qos_profile_sensor_data)
    ear = world.create_subscription(LaserScan, "/mine", print, 10)
    world.create_subscription(LaserScan, "/mine", print, qos_profile_sensor_data)
    mismatches.look()
    mismatches.look()
    [found] = told
    assert found == {
        "type": "topic_mismatch",
        "topic": "/mine",
        "publisher": "/bt_application",
        "subscriber": "/world",
        "reason": "qos",
        "message": "Nothing arrives: /bt_application publishes best effort, "
        "/world asks for reliable delivery.",
        "hint": "Subscribe with rclpy.qos.qos_profile_sensor_data, or publish with QoSProfile(depth=10).",
        "code": "reliability",
        "values": {"problem": found["values"]["problem"]},
        "resolved": False,
    }
    world.destroy_subscription(ear)
    mismatches.look()
    assert told[1:] == [{**found, "resolved": True}]
    world.create_subscription(LaserScan, "/mine", print, 10)
    mismatches.look()
    assert told[2:] == [found]  # it was gone meanwhile, as after another run


def test_topics_of_the_world_match_both_kinds_of_subscribers(context: Context) -> None:
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data

    from executor.ros.graph.mismatches import Mismatches
    from executor.ros.node import WorldNode
    from executor.ros.values import message_type
    from executor.world.simulation.launch import make_world

    world = make_world("walled_room")
    ours, theirs = WorldNode(world, context), Node("theirs", context=context)
    told: list[dict[str, Any]] = []
    said = [row for row in theirs.get_topic_names_and_types() if ours.node.count_publishers(row[0])]
    for topic, types in said:
        for qos in (10, qos_profile_sensor_data):
            theirs.create_subscription(message_type(types[0]), topic, print, qos)
    Mismatches(theirs, lambda message: told.append(to_builtins(message))).look()
    assert told == []
    assert {"/clock", "/scan", "/camera/image_raw", "/odom", "/imu", "/bumper"} <= {
        topic for topic, _ in said
    }
    for topic in ("/scan", "/camera/image_raw", "/depth_camera/depth/image_raw"):
        [end] = ours.node.get_publishers_info_by_topic(topic)
        assert end.qos_profile.reliability.name == "RELIABLE"
    theirs.destroy_node()
    ours.close()
    world.close()


class End:
    """An end of a topic in the graph: within one process a topic has only one type."""

    def __init__(self, node: str, kind: str) -> None:
        from rclpy.qos import QoSProfile

        self.node_name, self.node_namespace, self.topic_type = node, "/", kind
        self.qos_profile = QoSProfile(depth=10)


class Graph:
    def __init__(self, publishers: list[End], subscribers: list[End]) -> None:
        self._ends = publishers, subscribers

    def get_topic_names_and_types(self) -> list[tuple[str, list[str]]]:
        return [("/odom", [])]

    def get_node_names_and_namespaces(self) -> list[tuple[str, str]]:
        return []

    def count_publishers(self, _: str) -> int:
        return len(self._ends[0])

    def get_publishers_info_by_topic(self, _: str) -> list[End]:
        return self._ends[0]

    def get_subscriptions_info_by_topic(self, _: str) -> list[End]:
        return self._ends[1]


@pytest.mark.parametrize(
    ("publishers", "subscribers", "expected"),
    [
        ([("world", "Odom")], [("mine", "Text")], [("/world", "/mine")]),
        ([("world", "Odom")], [("mine", "Text"), ("other", "Odom")], [("/world", "/mine")]),
        ([("world", "Odom")], [("other", "Odom")], []),
        # The world may accept commands of two types; a publisher of either is connected.
        ([("mine", "Twist")], [("world", "Twist"), ("world_stamped", "Stamped")], []),
        ([("mine", "Text")], [("world", "Twist")], [("/mine", "/world")]),
    ],
)
def test_types_that_differ(
    publishers: list[tuple[str, str]], subscribers: list[tuple[str, str]], expected: list[tuple[str, str]]
) -> None:
    from executor.ros.graph.mismatches import Mismatches

    told: list[dict[str, Any]] = []
    ends = [[End(*end) for end in side] for side in (publishers, subscribers)]
    mismatches = Mismatches(Graph(*ends), lambda message: told.append(to_builtins(message)))
    mismatches.look()
    # A robot may subscribe to a second type soon: if it does not, the second check reports it.
    assert not any(found["subscriber"] == "/world" for found in told)
    mismatches.look()
    mismatches.look()
    assert [(found["publisher"], found["subscriber"]) for found in told] == expected
    assert all(found["reason"] == "type" and "same message type" in found["hint"] for found in told)


def test_an_end_that_is_missing_is_reported_when_it_does_not_come(graph: Any) -> None:
    from sensor_msgs.msg import LaserScan

    from executor.ros.graph.mismatches import PATIENCE

    world, application, told, mismatches = graph
    application.create_subscription(LaserScan, "/lidar", print, 10)
    for _ in range(PATIENCE - 1):
        mismatches.look()
    assert told == []
    mismatches.look()
    mismatches.look()
    [found] = told
    assert (found["topic"], found["subscriber"], found["code"]) == (
        "/lidar",
        "/bt_application",
        "unpublished",
    )
    world.create_publisher(LaserScan, "/lidar", 10)
    mismatches.look()
    assert told[1:] == [{**found, "resolved": True}]
