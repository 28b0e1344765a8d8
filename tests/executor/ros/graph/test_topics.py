import time
from typing import Any

import pytest
from geometry_msgs.msg import PoseStamped, Twist
from msgspec import convert, to_builtins
from rclpy.context import Context
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import String

from executor.ros.graph.topics import MOST_ECHOED, TopicError, TopicRequest, Topics
from executor.ros.node import take


class Panel:
    """A node with topics, and its replies."""

    def __init__(self, context: Context) -> None:
        self.node = Node("world", context=context)
        self.sent: list[dict[str, Any]] = []
        self.topics = Topics(self.node, lambda message: self.sent.append(to_builtins(message)))
        self.now_s = time.monotonic()

    def asks(self, type_: str, **fields: Any) -> None:
        self.topics.obey(convert({"type": type_, **fields}, TopicRequest))

    def polls(self, after_s: float = 0.0) -> None:
        self.now_s += after_s
        self.topics.poll(self.now_s)

    def said(self, type_: str) -> list[dict[str, Any]]:
        return [message for message in self.sent if message["type"] == type_]

    def row(self, name: str) -> dict[str, Any]:
        self.asks("list_topics")
        [row] = [row for row in self.said("topics")[-1]["topics"] if row["name"] == name]
        return dict(row)


@pytest.fixture
def panel(context: Context) -> Any:
    panel = Panel(context)
    yield panel
    panel.node.destroy_node()


def test_a_topic_is_listed_with_its_nodes_and_after_a_measurement_with_its_rate(
    panel: Panel, context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(time, "monotonic", lambda: panel.now_s)
    talker = Node("talker", namespace="/robot", context=context)
    publisher = talker.create_publisher(String, "/chatter", 10)
    first = panel.row("/chatter")
    assert first == {
        "name": "/chatter", "type": "std_msgs/msg/String", "hz": None, "bytes_per_s": None,
        "publishers": ["/robot/talker"], "subscribers": [], "types": ["std_msgs/msg/String"],
    }  # fmt: skip
    for n in range(20):
        publisher.publish(String(data=f"hello {n:02}"))
        panel.polls(0.1)
    row = panel.row("/chatter")
    assert row["hz"] == pytest.approx(10, abs=1)
    assert row["bytes_per_s"] == pytest.approx(10 * 20, rel=0.2)
    panel.now_s += 5
    assert panel.row("/chatter")["hz"] == 0
    talker.destroy_node()


def test_a_topic_is_echoed_at_the_requested_rate_until_it_is_ended(panel: Panel) -> None:
    publisher = panel.node.create_publisher(String, "/chatter", 10)
    panel.asks("echo_topic", topic="/chatter", max_hz=20.0)
    for n in range(10):
        publisher.publish(String(data=f"hello {n}"))
        panel.polls(0.02)
    echoed = panel.said("topic_message")
    assert echoed[0] == {
        "type": "topic_message", "topic": "/chatter", "message_type": "std_msgs/msg/String",
        "message": {"data": "hello 0"}, "bytes": 16,
    }  # fmt: skip
    assert len(echoed) == 4
    panel.asks("echo_topic", topic="/chatter", max_hz=0.0)
    publisher.publish(String(data="unheard"))
    panel.polls(1)
    assert len(panel.said("topic_message")) == 4


def test_a_latched_message_from_before_is_echoed(panel: Panel) -> None:
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = panel.node.create_publisher(String, "/description", latched)
    publisher.publish(String(data="robot"))
    panel.asks("echo_topic", topic="/description", max_hz=5.0)
    while not panel.said("topic_message"):
        panel.polls(0.01)
    assert panel.said("topic_message")[0]["message"] == {"data": "robot"}


def test_a_patient_echo_begins_when_the_topic_exists(panel: Panel) -> None:
    panel.asks("echo_topic", topic="/later", max_hz=5.0, patient=True)
    panel.polls()
    publisher = panel.node.create_publisher(String, "/later", 1)
    panel.polls(1)
    publisher.publish(String(data="now"))
    panel.polls(1)
    assert panel.said("topic_message")[0]["message"] == {"data": "now"}


def test_images_are_subscribed_to_only_for_an_echo(panel: Panel) -> None:
    publisher = panel.node.create_publisher(Image, "/picture", 1)
    assert panel.row("/picture")["hz"] is None
    assert publisher.get_subscription_count() == 0
    panel.asks("echo_topic", topic="/picture", max_hz=5.0)
    publisher.publish(Image(data=bytes(5000)))
    panel.polls()
    [message] = panel.said("topic_message")
    assert message["cut"] == {"data": 5000}
    assert message["bytes"] > 5000


def test_a_message_is_published_to_its_subscribers(panel: Panel) -> None:
    ear = panel.node.create_subscription(PoseStamped, "/goal", print, 10)
    fields = {"header": {"frame_id": "odom"}, "pose": {"position": {"x": 1, "y": 2.5}}}
    panel.asks("publish_topic", topic="/goal", message_type="geometry_msgs/PoseStamped", message=fields)
    heard = None
    while heard is None:
        panel.polls(0.001)
        heard = take(ear)
    assert heard.header.frame_id == "odom"
    assert (heard.pose.position.x, heard.pose.position.y, heard.pose.orientation.w) == (1.0, 2.5, 1.0)


def test_a_type_is_described(panel: Panel) -> None:
    panel.asks("describe_type", message_type="geometry_msgs/msg/Twist")
    zero = {"x": 0.0, "y": 0.0, "z": 0.0}
    assert panel.sent == [
        {
            "type": "type_description",
            "message_type": "geometry_msgs/msg/Twist",
            "fields": {"linear": "geometry_msgs/Vector3", "angular": "geometry_msgs/Vector3"},
            "example": {"linear": zero, "angular": zero},
        }
    ]


@pytest.mark.parametrize(
    ("asked", "code", "text"),
    [
        ({"type": "echo_topic", "topic": "/ghost", "max_hz": 1.0}, "unknown_topic", "no topic '/ghost'"),
        ({"type": "describe_type", "message_type": "os/msg/Path"}, "unknown_type", "not installed"),
        ({"type": "describe_type", "message_type": "../etc"}, "unknown_type", "is no message type"),
        ({"topic": "/x", "message_type": "ghost_msgs/msg/Ghost"}, "unknown_type", "not installed"),
        ({"topic": "/x y", "message_type": "std_msgs/msg/String"}, "bad_topic", "no name of a topic"),
        ({"topic": "/x", "message_type": "std_msgs/String", "message": {"dat": ""}}, "bad_message", "dat"),
        ({"topic": "/scan", "message_type": "std_msgs/msg/String"}, "type_differs", "LaserScan"),
    ],
)  # fmt: skip
def test_impossible_requests_are_refused(panel: Panel, asked: dict[str, Any], code: str, text: str) -> None:
    panel.node.create_publisher(LaserScan, "/scan", 1)
    with pytest.raises(TopicError, match=text) as caught:
        panel.asks(**({"type_": asked.get("type", "publish_topic"), "message": {}} | without_type(asked)))
    assert caught.value.code == code


def without_type(asked: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in asked.items() if name != "type"}


def test_a_panel_cannot_listen_to_everything(panel: Panel) -> None:
    publishers = [panel.node.create_publisher(Twist, f"/t{n}", 1) for n in range(MOST_ECHOED + 1)]
    assert publishers
    for n in range(MOST_ECHOED):
        panel.asks("echo_topic", topic=f"/t{n}", max_hz=1.0)
    with pytest.raises(TopicError, match="At most"):
        panel.asks("echo_topic", topic=f"/t{MOST_ECHOED}", max_hz=1.0)
