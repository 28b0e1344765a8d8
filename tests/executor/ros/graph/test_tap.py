"""The topics of other processes, taken raw for a recording."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import pytest
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Image
from std_msgs.msg import Int32, String

from executor.ros.graph import tap as graph_tap
from executor.ros.graph.tap import GraphTap, share_after
from executor.ros.raw_subscription import DEPTH

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from rclpy.context import Context


class Taken:
    """A tap, and what it took."""

    def __init__(self, context: Context) -> None:
        self.messages: list[tuple[str, str, bytes, float]] = []
        self.notes: list[str] = []
        self.now_s = 0.0
        self.tap = GraphTap(context, {"/own"}, lambda *taken: self.messages.append(taken), self.notes.append)

    def poll(self) -> None:
        self.now_s += graph_tap.LOOK_S
        self.tap.poll(self.now_s)

    def poll_until(self, condition: Callable[[], Any]) -> None:
        end_s = time.monotonic() + 20
        while not condition():
            assert time.monotonic() < end_s
            self.poll()
            time.sleep(0.005)

    def texts(self, topic: str) -> list[str]:
        return [deserialize_message(data, String).data for name, _, data, _ in self.messages if name == topic]


@pytest.fixture
def taken(context: Context) -> Iterator[Taken]:
    made = Taken(context)
    yield made
    made.tap.close()


@pytest.fixture
def talker(context: Context) -> Iterator[Node]:
    node = Node("talker", context=context)
    yield node
    node.destroy_node()


def test_each_message_of_a_topic_that_appears_is_taken_once_with_its_type(taken: Taken, talker: Node) -> None:
    publisher = talker.create_publisher(String, "/chatter", 10)
    own = talker.create_publisher(String, "/own", 10)
    taken.poll_until(publisher.get_subscription_count)
    for text in "abc":
        publisher.publish(String(data=text))
        own.publish(String(data=text))
    taken.poll_until(lambda: len(taken.texts("/chatter")) >= 3)
    taken.poll()
    assert taken.texts("/chatter") == ["a", "b", "c"]
    assert {(topic, kind) for topic, kind, *_ in taken.messages} == {("/chatter", "std_msgs/msg/String")}
    assert own.get_subscription_count() == 0


def test_a_topic_without_publishers_is_given_up_and_found_again(taken: Taken, talker: Node) -> None:
    publisher = talker.create_publisher(String, "/chatter", 10)
    taken.poll_until(publisher.get_subscription_count)
    talker.destroy_publisher(publisher)
    taken.poll_until(lambda: not talker.count_subscribers("/chatter"))
    again = talker.create_publisher(Int32, "/chatter", 10)
    taken.poll_until(again.get_subscription_count)
    again.publish(Int32(data=1))
    taken.poll_until(lambda: taken.messages)
    assert taken.messages[0][1] == "std_msgs/msg/Int32"


def test_latched_messages_come_again_for_each_run(taken: Taken, talker: Node) -> None:
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    talker.create_publisher(String, "/map_name", latched).publish(String(data="house"))
    taken.poll_until(lambda: taken.texts("/map_name"))
    taken.tap.restart()
    taken.poll_until(lambda: len(taken.texts("/map_name")) == 2)
    assert taken.texts("/map_name") == ["house", "house"]


def test_what_cannot_be_recorded_is_noted_once(
    taken: Taken, talker: Node, monkeypatch: pytest.MonkeyPatch
) -> None:
    pictures = talker.create_publisher(Image, "/debug_image", 10)
    taken.poll_until(lambda: taken.notes)
    taken.poll()
    assert taken.notes == [
        "/debug_image is not recorded: messages of the type sensor_msgs/msg/Image are too large; "
        "publish a CompressedImage."
    ]
    assert pictures.get_subscription_count() == 0
    monkeypatch.setattr(graph_tap, "MOST_TOPICS", 0)
    talker.create_publisher(String, "/one_more", 10)
    taken.poll_until(lambda: len(taken.notes) > 1)
    assert taken.notes[1:] == [
        "/one_more is not recorded: a recording holds at most 0 topics of other processes."
    ]


@pytest.mark.parametrize(("sent_ns", "share"), [(100, 1.0), (150, 0.75), (300, 0.0), (90, 1.0), (310, 0.0)])
def test_when_a_message_was_sent_is_a_share_of_the_time_between_two_looks(sent_ns: int, share: float) -> None:
    assert share_after(sent_ns, 100, 300) == share
    assert share_after(sent_ns, 300, 300) in {0.0, 1.0}


def test_a_message_comes_with_when_it_was_sent(taken: Taken, talker: Node) -> None:
    publisher = talker.create_publisher(String, "/chatter", 10)
    taken.poll_until(publisher.get_subscription_count)
    for text in "ab":
        publisher.publish(String(data=text))
    taken.poll_until(lambda: len(taken.texts("/chatter")) == 2)
    shares = [share for *_, share in taken.messages]
    assert all(0.0 < share <= 1.0 for share in shares)


def test_many_messages_are_looked_for_at_every_turn(taken: Taken, talker: Node) -> None:
    publisher = talker.create_publisher(String, "/chatter", QoSProfile(depth=50))
    taken.poll_until(publisher.get_subscription_count)
    taken.poll()
    assert not taken.tap.is_due(taken.now_s + graph_tap.POLL_S / 2)
    assert taken.tap.is_due(taken.now_s + graph_tap.POLL_S)
    most = DEPTH // 4

    def busy() -> bool:
        for _ in range(most + 10):
            publisher.publish(String(data="x"))
        return taken.tap.is_due(taken.now_s)

    taken.poll_until(busy)
