"""An import proposes a universe by the topics of its actions."""

from __future__ import annotations

import pytest

from translator.proposal import TopicUse, propose, topics_used

LISTEN = "self.node.create_subscription({}, 10)"


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        (
            LISTEN.format('LaserScan, "/scan", self.hear'),
            [TopicUse("/scan", "LaserScan", is_published=False)],
        ),
        (LISTEN.format('sensor_msgs.msg.Image, "cam", f'), [TopicUse("/cam", "Image", is_published=False)]),
        (
            'n.create_publisher(msg_type=Twist, topic="/cmd_vel", qos_profile=10)',
            [TopicUse("/cmd_vel", "Twist", is_published=True)],
        ),
        (
            'TOPIC = "/scan"\n' + LISTEN.format("LaserScan, TOPIC, f"),
            [TopicUse("/scan", "LaserScan", is_published=False)],
        ),
        (
            'message_filters.Subscriber(node, Image, "/left")',
            [TopicUse("/left", "Image", is_published=False)],
        ),
        (LISTEN.format("LaserScan, self.ports['topic'], f"), []),
        (LISTEN.format("LaserScan, 7, f"), []),
        ("def broken(:", []),
    ],
)
def test_the_topics_of_a_source(source: str, expected: list[TopicUse]) -> None:
    assert topics_used(source) == expected


def subscribing(kind: str, topic: str) -> bytes:
    return f'self.node.create_subscription({kind}, "{topic}", self.hear, 10)'.encode()


@pytest.mark.parametrize(
    ("kind", "topic", "project", "universe"),
    [
        ("LaserScan", "/f1/laser/scan", "avoid", "circuit_obstacles"),
        ("Image", "/cam_f1_left/image_raw", "Follow the line", "circuit"),
        ("LaserScan", "/scan", "avoid", "walled_room"),
        ("Bool", "/bumper", "bump", "walled_room"),
        ("Image", "/depth_camera/image_raw", "follow", "person_in_green"),
        ("Image", "/camera/image_raw", "Follow the line", "line"),
        ("OccupancyGrid", "/map", "navigate", "warehouse"),
        ("Odometry", "/odom", "square", "walled_room"),
    ],
)
def test_what_is_proposed(kind: str, topic: str, project: str, universe: str) -> None:
    proposal = propose({"actions/A.py": subscribing(kind, topic)}, hints=[project])
    assert proposal is not None
    assert (proposal.universe, proposal.robot, proposal.reason) == (universe, None, topic)


def test_a_camera_goes_before_a_lidar_and_a_moved_camera_asks_for_its_robot() -> None:
    actions = {
        "actions/A.py": subscribing("LaserScan", "/scan"),
        "actions/B.py": subscribing("Image", "/camera/image_raw"),
        "actions/C.py": b'n.create_publisher(Float64, "/camera/pan/command", 10)',
    }
    proposal = propose(actions)
    assert proposal is not None
    assert (proposal.universe, proposal.robot) == ("person_in_green", "lookout")


def test_nothing_is_proposed_without_a_topic_that_says_anything() -> None:
    assert propose({}) is None
    assert propose({"actions/A.py": subscribing("String", "/words")}) is None
