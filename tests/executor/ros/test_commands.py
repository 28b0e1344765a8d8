"""Robots accept Twist, TwistStamped, or both on `/cmd_vel`, from this participant and from others."""

import time
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest
import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from msgspec import convert, to_builtins
from rclpy.context import Context
from rclpy.node import Node

from executor.child_messages import ListTopics
from executor.robots import load_robot
from executor.ros.commands import AWAIT_S, REPEAT_S, Commands
from executor.ros.graph.topics import TopicError, TopicRequest, Topics
from executor.ros.node import WorldNode
from executor.ros.shared_topics import share_commands
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld
from tests.executor.ros.conftest import DOMAIN_ID

WAIT_S = 30


@pytest.fixture
def world() -> Iterator[BulletWorld]:
    made = BulletWorld(load_builtin("empty"), robot="burger")
    yield made
    made.close()


@pytest.fixture
def outside() -> Iterator[Context]:
    """Yields the context of a second participant, which stands for another process."""
    made = Context()
    rclpy.init(context=made, domain_id=DOMAIN_ID)
    yield made
    made.try_shutdown()


def stamped(linear: float, at_s: float = 0.0) -> TwistStamped:
    message = TwistStamped()
    message.header.stamp.sec = int(at_s)
    message.header.stamp.nanosec = round(at_s % 1 * 1e9)
    message.twist.linear.x = linear
    return message


def drive(world: BulletWorld, node: WorldNode, publisher: Any, message: Any, until_m: float) -> float:
    """Publishes until the robot has driven that distance; returns the distance."""
    end_s = time.monotonic() + WAIT_S
    while world.robots[0].distance_m < until_m and time.monotonic() < end_s:
        publisher.publish(message)
        node.poll()
        world.step(4)
        time.sleep(0.002)
    return world.robots[0].distance_m


@pytest.mark.parametrize("message", [Twist(), TwistStamped()], ids=lambda each: type(each).__name__)
def test_both_kinds_of_command_move_a_built_in_robot(
    world: BulletWorld, context: Context, outside: Context, message: Any
) -> None:
    node, other = WorldNode(world, context), Node("driver", context=outside)
    twist = message.twist if isinstance(message, TwistStamped) else message
    twist.linear.x = 0.2
    publisher = other.create_publisher(type(message), "/cmd_vel", 10)
    assert drive(world, node, publisher, message, 0.1) >= 0.1
    assert (node._second is not None) == isinstance(message, TwistStamped), "made when it is needed alone"
    node.close()
    other.destroy_node()


def test_a_robot_for_twist_alone_never_creates_a_second_participant(
    world: BulletWorld, context: Context, outside: Context
) -> None:
    node, other = Node("world", context=context), Node("driver", context=outside)
    commands = Commands(node, "/only/cmd_vel", "twist", 0.6, lambda: pytest.fail("not needed"))
    publisher = other.create_publisher(TwistStamped, "/only/cmd_vel", 10)
    end_s = time.monotonic() + WAIT_S
    while not node.get_publishers_info_by_topic("/only/cmd_vel") and time.monotonic() < end_s:
        time.sleep(0.01)
    for _ in range(60):
        publisher.publish(stamped(0.2))
        assert commands.take(1.0) == (None, True)
    for each in (node, other):
        each.destroy_node()


def test_a_publisher_of_the_second_type_is_found_by_the_next_look(context: Context, outside: Context) -> None:
    node, other = Node("world", context=context), Node("driver", context=outside)
    made: list[Node] = []

    def second() -> Node:
        made.append(other)
        return other

    commands = Commands(node, "/soon/cmd_vel", "both", 0.6, second)
    other.create_publisher(TwistStamped, "/soon/cmd_vel", 10)
    end_s = time.monotonic() + WAIT_S
    while not node.get_publishers_info_by_topic("/soon/cmd_vel") and time.monotonic() < end_s:
        time.sleep(0.01)
    commands.take(1.0)
    assert made == [other]
    for each in (node, other):
        each.destroy_node()


def test_the_world_waits_for_a_publisher_that_it_has_seen_and_for_what_that_repeats(
    context: Context, outside: Context
) -> None:
    far = Context()
    rclpy.init(context=far, domain_id=DOMAIN_ID)
    node, other = Node("world", context=context), Node("driver", context=outside)
    second = Node("second", context=far)
    commands = Commands(node, "/seen/cmd_vel", "both", 0.6, lambda: second)
    assert not commands.awaits_publisher(time.monotonic())
    other.create_publisher(TwistStamped, "/seen/cmd_vel", 10)
    end_s = time.monotonic() + WAIT_S
    while not node.get_publishers_info_by_topic("/seen/cmd_vel") and time.monotonic() < end_s:
        time.sleep(0.01)
    commands.take(1.0)
    seen_s = time.monotonic()
    assert commands.awaits_publisher(seen_s)
    assert not commands.awaits_publisher(seen_s + AWAIT_S), "at most so long"
    while not commands._subscriptions[TwistStamped].get_publisher_count() and time.monotonic() < end_s:
        time.sleep(0.01)
    assert commands.awaits_publisher(seen_s)
    assert not commands.awaits_publisher(seen_s + REPEAT_S)
    for each in (node, other, second):
        each.destroy_node()
    far.try_shutdown()


def test_a_robot_for_twist_stamped_alone_uses_the_first_participant(context: Context) -> None:
    node = Node("world", context=context)
    commands = Commands(node, "/own/cmd_vel", "twist_stamped", 0.6, lambda: pytest.fail("not needed"))
    publisher = node.create_publisher(TwistStamped, "/own/cmd_vel", 10)
    publisher.publish(stamped(0.3, 4.9))
    command, obeyed = commands.take(5.0)
    assert obeyed
    assert command == pytest.approx((0.3, 0.0, 4.9))
    node.destroy_node()


@pytest.mark.parametrize(
    ("stamp_s", "now_s", "wanted_at_s"),
    [(0.0, 5.0, 5.0), (4.7, 5.0, 4.7), (1_700_000_000.0, 5.0, 5.0), (4.3, 5.0, None)],
    ids=["no stamp is now", "a stamp counts", "wall time is now", "too old"],
)
def test_a_command_is_valid_from_its_stamp(
    context: Context, stamp_s: float, now_s: float, wanted_at_s: float | None
) -> None:
    node = Node("world", context=context)
    commands = Commands(node, "/own/cmd_vel", "twist_stamped", 0.6, lambda: node)
    publisher = node.create_publisher(TwistStamped, "/own/cmd_vel", 10)
    for _ in range(3):
        publisher.publish(stamped(0.3, stamp_s))
        command, obeyed = commands.take(now_s)
        assert obeyed == (wanted_at_s is not None)
        assert (command and command.at_s) == (None if wanted_at_s is None else pytest.approx(wanted_at_s))
    assert len(commands.notes) == (wanted_at_s is None), "said once"
    assert all("use_sim_time" in note and "0.70 s old" in note for note in commands.notes)
    node.destroy_node()


def test_a_stamped_command_ends_with_its_timeout_from_the_stamp(world: BulletWorld) -> None:
    robot = world.robots[0]
    world.step(240)
    robot.command(0.2, 0.0, world.time_s - 0.5)  # valid for another 0.1 s
    world.step(24)
    assert robot.odometry.linear > 0.01
    world.step(240)
    assert robot.odometry.linear == pytest.approx(0.0, abs=1e-3)


def test_in_one_participant_the_robot_uses_the_type_of_the_application(
    world: BulletWorld, context: Context
) -> None:
    """As in lock-step: a participant supports one type for a topic, and the first command counts."""
    node, application = WorldNode(world, context), Node("application", context=context)
    undo = share_commands(node, context)
    for kind, message in ((TwistStamped, stamped(0.2)), (Twist, stamped(0.2).twist)):
        publisher = application.create_publisher(kind, "cmd_vel", 10)
        publisher.publish(message)
        node.poll()
        world.step(60)
        assert world.robots[0].odometry.linear > 0.1, kind
        application.destroy_publisher(publisher)
        world.reset()
    undo()
    assert node._second is None
    application.destroy_node()
    node.close()


def test_the_page_sees_both_types_and_publishes_either(world: BulletWorld, context: Context) -> None:
    node = WorldNode(world, context)
    sent: list[dict[str, Any]] = []
    topics = Topics(node.node, lambda message: sent.append(to_builtins(message)), commands=node)
    topics.obey(ListTopics())
    [row] = [each for each in sent[-1]["topics"] if each["name"] == "/cmd_vel"]
    names = ["geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"]
    assert (row["type"], row["types"]) == (names[0], names)
    message = {"twist": {"linear": {"x": 0.2}}}
    say = {"type": "publish_topic", "topic": "/cmd_vel", "message_type": names[1], "message": message}
    end_s = time.monotonic() + WAIT_S
    while world.robots[0].distance_m < 0.02 and time.monotonic() < end_s:
        topics.obey(convert(say, TopicRequest))
        topics.poll(time.monotonic())
        node.poll()
        world.step(4)
        time.sleep(0.002)
    assert world.robots[0].distance_m >= 0.02
    with pytest.raises(TopicError, match="is of the type geometry_msgs/msg/Twist, not std_msgs"):
        topics.obey(
            convert({**say, "message_type": "std_msgs/msg/String", "message": {"data": "x"}}, TopicRequest)
        )
    node.close()


def test_a_robot_names_its_command_type() -> None:
    config = load_robot("turtle2")
    assert config.command_type == "both"
    assert replace(config, command_type="twist").command_type == "twist"
