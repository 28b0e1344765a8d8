"""Zero velocities, only where the node itself has commanded motion."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

import pytest
import rclpy
import rclpy.time
from geometry_msgs.msg import Twist, TwistStamped, Vector3
from rclpy.context import Context
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String

from tests.deadline import DEADLINE_S
from tests.domains import own_domain_id
from tree_gardener import ros_commanded
from tree_gardener.ros_commanded import Commanded
from tree_gardener.ros_node import ActionNode

if TYPE_CHECKING:
    from collections.abc import Iterator

FAST = Twist(linear=Vector3(x=0.1))
TURNS = TwistStamped(twist=Twist(angular=Vector3(z=0.2)))
TURNS.header.frame_id = "base"


class Published(list[Any]):
    """The messages that publishers were given; they send nothing."""

    def publisher(self, node: Any, kind: Any, topic: str, **options: Any) -> Any:
        """A publisher of rclpy that only notes, watched as those of a node are."""
        made = node.create_publisher(kind, topic, QoSProfile(depth=3, **options))
        made.publish = lambda message: self.append((topic, message))
        node.commanded.watch(made)
        return made


@pytest.fixture
def node() -> Iterator[ActionNode]:
    context = Context()
    rclpy.init(context=context, domain_id=own_domain_id())
    made = ActionNode("moving", context=context)
    made.commanded = Commanded(made, sleep=lambda _: None)
    yield made
    made.close()
    context.try_shutdown()


def test_only_topics_on_which_it_has_commanded_motion_get_zeros(node: ActionNode) -> None:
    sent = Published()
    moves, rests, turns, speaks = (
        sent.publisher(node, kind, topic)
        for kind, topic in ((Twist, "/a"), (Twist, "/b"), (TwistStamped, "/c"), (String, "/d"))
    )
    node.create_subscription(Twist, "/e", lambda _: None, 1)
    moves.publish(FAST)
    moves.publish(Twist())
    rests.publish(Twist())
    turns.publish(TURNS)
    speaks.publish(String(data="go"))
    sent.clear()
    node.commanded.stop()
    assert [(topic, type(message)) for topic, message in sent] == [("/a", Twist), ("/c", TwistStamped)]
    assert sent[0][1] == Twist()
    stamped = sent[1][1]
    assert (stamped.twist, stamped.header.frame_id) == (Twist(), "base")
    assert stamped.header.stamp.sec > 0

    node.commanded.stop(10)
    assert len(sent) == 22
    node.commanded.begin()
    node.commanded.stop()
    assert len(sent) == 22, "another run has moved nothing yet"


def test_raw_bytes_count_as_motion(node: ActionNode) -> None:
    sent = Published()
    sent.publisher(node, Twist, "/a").publish(b"\0\1")
    node.commanded.stop()
    assert [message for _, message in sent] == [b"\0\1", Twist()]


def test_a_publisher_that_the_action_destroyed_is_made_again_with_its_qos(
    node: ActionNode, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ros_commanded, "DISCOVERY_S", 0.0)
    sent = Published()
    publisher = sent.publisher(node, Twist, "/a", reliability=ReliabilityPolicy.BEST_EFFORT)
    publisher.publish(FAST)
    node.destroy_publisher(publisher)
    node.commanded.stop()
    [made] = [each for each in node.publishers if each.topic_name == "/a"]
    assert (made.msg_type, made.qos_profile.reliability, made.qos_profile.depth) == (
        *(Twist, ReliabilityPolicy.BEST_EFFORT, 3),
    )


def test_the_end_of_a_run_awaits_the_last_commands_where_publishers_are_left(node: ActionNode) -> None:
    kept, gone = (node.create_publisher(Twist, topic, 1) for topic in ("/a", "/b"))
    awaited: list[str] = []
    for publisher in (kept, gone):
        topic = publisher.topic_name
        publisher.wait_for_all_acked = lambda _, topic=topic: awaited.append(topic)
        publisher.publish(FAST)
    node.destroy_publisher(gone)
    node.commanded.end()
    node.commanded.end()
    assert awaited == ["/a"], "of this run, once"


def test_a_motion_that_no_command_follows_is_stopped_once(
    node: ActionNode, monkeypatch: pytest.MonkeyPatch
) -> None:
    now = [10.0]
    monkeypatch.setattr(node, "get_clock", lambda: Stopped(now))
    sent = Published()
    moves, rests = sent.publisher(node, Twist, "/a"), sent.publisher(node, Twist, "/b")
    moves.publish(FAST)
    rests.publish(FAST)
    rests.publish(Twist())
    sent.clear()
    now[0] = 10.5
    node.commanded.expire(0.5)
    assert sent == []
    now[0] = 10.6
    node.commanded.expire(0.5)
    node.commanded.expire(0.5)
    assert sent == [("/a", Twist())]
    moves.publish(FAST)
    now[0] = 11.2
    node.commanded.expire(0.5)
    assert sent[1:] == [("/a", FAST), ("/a", Twist())], "it moved again"


@pytest.mark.parametrize("timeout_s", [0.0, 0.001])
def test_a_thread_looks_while_the_tree_ticks(node: ActionNode, timeout_s: float) -> None:
    sent = Published()
    moves = sent.publisher(node, Twist, "/a")
    end = node.commanded.watched(timeout_s)
    moves.publish(FAST)
    end_s = time.monotonic() + DEADLINE_S
    while timeout_s and len(sent) == 1:
        assert time.monotonic() < end_s, "it was not stopped"
        time.sleep(0.01)
    end()
    assert [message for _, message in sent] == ([FAST, Twist()] if timeout_s else [FAST])


class Stopped:
    """A clock that is moved by hand."""

    def __init__(self, now: list[float]) -> None:
        self.now_s = now

    def now(self) -> Any:
        return rclpy.time.Time(nanoseconds=round(self.now_s[0] * 1e9))
