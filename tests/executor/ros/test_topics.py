import time
from typing import Any

import pytest
from geometry_msgs.msg import PoseStamped
from rclpy.context import Context
from rclpy.node import Node
from sensor_msgs.msg import Image
from std_msgs.msg import String

from executor.ros.node import take
from executor.ros.topics import LARGEST_LIST, Topics, fill, message_type, to_builtins


def test_a_topic_is_listed_heard_and_echoed(context: Context) -> None:
    node = Node("world", context=context)
    sent: list[dict[str, Any]] = []
    topics = Topics(node, sent.append)
    publisher = node.create_publisher(String, "/chatter", 10)
    topics.obey({"type": "list_topics"})
    topics.obey({"type": "echo_topic", "topic": "/chatter", "max_hz": 20.0})
    now_s = time.monotonic()
    for i in range(10):
        publisher.publish(String(data=f"hello {i}"))
        topics.poll(now_s + i * 0.02)
    echoed = [message for message in sent if message["type"] == "topic_message"]
    assert echoed[0] == {
        "type": "topic_message", "topic": "/chatter", "message_type": "std_msgs/msg/String",
        "message": {"data": "hello 0"},
    }  # fmt: skip
    assert len(echoed) < 10
    topics.obey({"type": "list_topics"})
    [row] = [row for row in sent[-1]["topics"] if row["name"] == "/chatter"]
    assert row["type"] == "std_msgs/msg/String"
    assert row["hz"] > 5
    assert row["bytes_per_s"] > 0
    topics.obey({"type": "echo_topic", "topic": "/chatter", "max_hz": 0.0})
    count = len(sent)
    publisher.publish(String(data="unheard"))
    topics.poll(now_s + 1)
    assert len(sent) == count
    node.destroy_node()


def test_pictures_are_listed_but_not_listened_to(context: Context) -> None:
    node = Node("world", context=context)
    publisher = node.create_publisher(Image, "/picture", 1)
    Topics(node, lambda _: None).obey({"type": "list_topics"})
    assert publisher.get_subscription_count() == 0
    node.destroy_node()


def test_a_message_can_be_published(context: Context) -> None:
    node = Node("world", context=context)
    ear = node.create_subscription(PoseStamped, "/goal", print, 10)
    fields = {"header": {"frame_id": "odom"}, "pose": {"position": {"x": 1, "y": 2.5}}}
    message = {"topic": "/goal", "message_type": "geometry_msgs/msg/PoseStamped", "message": fields}
    Topics(node, lambda _: None).obey({"type": "publish_topic"} | message)
    heard = take(ear)
    assert heard.header.frame_id == "odom"
    assert (heard.pose.position.x, heard.pose.position.y) == (1.0, 2.5)
    node.destroy_node()


def test_what_is_not_there_is_refused(context: Context) -> None:
    node = Node("world", context=context)
    topics = Topics(node, lambda _: None)
    with pytest.raises(ValueError, match="nobody publishes /ghost"):
        topics.obey({"type": "echo_topic", "topic": "/ghost", "max_hz": 1.0})
    with pytest.raises(ValueError, match="not installed"):
        message_type("ghost_msgs/msg/Ghost")
    with pytest.raises(ValueError, match="no field 'dat'; it has data"):
        fill(String(), {"dat": "x"})
    with pytest.raises(ValueError, match="data"):
        fill(String(), {"data": 5})
    node.destroy_node()


def test_long_arrays_are_cut() -> None:
    picture = Image(data=bytes(5000))
    assert len(to_builtins(picture)["data"]) == LARGEST_LIST
