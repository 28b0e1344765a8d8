"""The world's node of a sealed run: what it publishes waits, and what it hears is checked."""

from geometry_msgs.msg import Twist
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import String

from executor.evaluation.sealed.link import Heard, Topic
from executor.evaluation.sealed.remote import RemoteNode
from executor.ros.raw_take import ignore, take

TWIST = "geometry_msgs/msg/Twist"


def test_messages_wait_in_order_and_are_taken_once():
    node = RemoteNode()
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    first, second = node.create_publisher(String, "/a", 10), node.create_publisher(String, "/b", latched)
    assert node.publishers == [
        Topic("/a", ("std_msgs/msg/String",), 10),
        Topic("/b", ("std_msgs/msg/String",), 1, is_latched=True),
    ]
    for publisher, text in ((second, "1"), (first, "2"), (second, "3")):
        publisher.publish(String(data=text))
    sent = node.take_sent()
    assert [(each.publisher, deserialize_message(each.data, String).data) for each in sent] == [
        (1, "1"),
        (0, "2"),
        (1, "3"),
    ]
    assert node.take_sent() == []


def test_subscribers_are_counted_by_what_the_other_process_says():
    node = RemoteNode()
    publisher = node.create_publisher(String, "/a", 10)
    assert publisher.get_subscription_count() == 0
    node.hear([2], (), lambda *_: None)
    assert publisher.get_subscription_count() == 2
    node.hear([5, 5, 5], (), lambda *_: None)  # of another number of publishers
    assert publisher.get_subscription_count() == 2


def test_only_known_topics_types_and_readable_messages_are_heard():
    node, ways = RemoteNode(), []
    subscription = node.create_subscription(Twist, "/cmd_vel", ignore, 2)
    twist = Twist()
    heard = [
        Heard("/ground_truth/odom", TWIST, b""),
        Heard("/cmd_vel", "std_msgs/msg/String", serialize_message(String(data="x"))),
        Heard("/cmd_vel", TWIST, b"\x00\x01"),
    ]
    for speed in (1.0, 2.0):
        twist.linear.x = speed
        heard.append(Heard("/cmd_vel", TWIST, serialize_message(twist)))
    node.hear([], heard[:3], lambda topic, type_: ways.append((topic, type_)))
    assert take(subscription) is None
    node.hear([], heard, lambda *_: None)
    assert take(subscription).linear.x == 1.0  # the depth is 2
    assert take(subscription).linear.x == 2.0
    assert take(subscription) is None
    assert ways[1] == ("/cmd_vel", "std_msgs/msg/String")
    assert node.destroy_subscription(subscription)
    assert node.get_publishers_info_by_topic("/cmd_vel") == []
