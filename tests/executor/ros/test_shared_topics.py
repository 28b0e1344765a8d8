"""Types of topics that an application shares with its world, in one participant and in two."""

from __future__ import annotations

import time
from threading import Thread
from typing import TYPE_CHECKING

import pytest
import rclpy
from geometry_msgs.msg import Twist, TwistStamped
from rclpy.context import Context
from rclpy.node import Node

from executor.ros.commands import STAMPED
from executor.ros.node import WorldNode
from executor.ros.shared_topics import TopicTypeError, await_commands, share_commands
from executor.universes import load_builtin
from executor.world.physics.bullet import BulletWorld
from tests.executor.ros.conftest import DOMAIN_ID

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

WAIT_S = 30.0


def wait_until(done: Callable[[], object]) -> None:
    end_s = time.monotonic() + WAIT_S
    while not done() and time.monotonic() < end_s:
        time.sleep(0.005)
    assert done()


@pytest.fixture
def others() -> Iterator[list[Node]]:
    """Yields the nodes of two further participants."""
    contexts = [Context(), Context()]
    for each in contexts:
        rclpy.init(context=each, domain_id=DOMAIN_ID)
    nodes = [Node(f"other_{number}", context=each) for number, each in enumerate(contexts)]
    yield nodes
    for node in nodes:
        node.destroy_node()
        node.context.try_shutdown()


def test_a_second_type_in_one_program_is_refused_in_our_words(
    context: Context, capfd: pytest.CaptureFixture[str]
) -> None:
    world = BulletWorld(load_builtin("empty"), robot="burger")
    node, application = WorldNode(world, context), Node("application", context=context)
    undo = share_commands(node, context)
    first = application.create_publisher(Twist, "cmd_vel", 10)
    for make in (
        lambda: application.create_publisher(TwistStamped, "/cmd_vel", 10),
        lambda: application.create_subscription(TwistStamped, "/cmd_vel", print, 10),
    ):
        with pytest.raises(TopicTypeError, match=r"/cmd_vel is of the type geometry_msgs/msg/Twist in this"):
            make()
    first.publish(Twist())  # the first one still works
    assert "rcutils" not in capfd.readouterr().err
    application.destroy_publisher(first)
    assert application.create_publisher(TwistStamped, "/cmd_vel", 10)
    undo()
    application.destroy_node()
    node.close()
    world.close()


def test_a_stamped_publisher_waits_for_the_robot_that_makes_its_subscription(
    context: Context, others: list[Node]
) -> None:
    application = Node("application", context=context)
    robot, second = others
    robot.create_subscription(Twist, "/cmd_vel", print, 10)
    second.create_subscription(Twist, "/known", print, 10)
    wait_until(lambda: application.count_subscribers("/cmd_vel") and application.count_subscribers("/known"))

    def follow() -> None:
        wait_until(
            lambda: STAMPED in {end.topic_type for end in robot.get_publishers_info_by_topic("/cmd_vel")}
        )
        second.create_subscription(TwistStamped, "/cmd_vel", print, 10)

    undo = await_commands(application, WAIT_S)
    thread = Thread(target=follow)
    thread.start()
    publisher = application.create_publisher(TwistStamped, "/cmd_vel", 10)
    assert publisher.get_subscription_count() == 1
    thread.join()
    undo()
    application.destroy_node()


def test_nobody_waits_where_no_robot_is_or_for_other_types(context: Context) -> None:
    application = Node("application", context=context)
    undo = await_commands(application, 1e9)
    assert application.create_publisher(TwistStamped, "/nobody/cmd_vel", 10)
    assert application.create_publisher(Twist, "/other/cmd_vel", 10)
    with pytest.raises(TopicTypeError, match="use one of them in all actions"):
        application.create_publisher(TwistStamped, "/other/cmd_vel", 10)
    undo()
    application.destroy_node()
