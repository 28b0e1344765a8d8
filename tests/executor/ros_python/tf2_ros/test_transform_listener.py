"""tf2 between nodes: broadcasters, listeners, and waits for later transforms."""

import threading
from typing import Any

import pytest
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.time import Time

from executor.ros.spin import DrainingExecutor
from tests.executor.ros_python.tf2_py.test_core import at, plain, stamped


@pytest.fixture
def node(context: Context) -> Any:
    made = Node("frames", context=context)
    yield made
    made.destroy_node()


def test_a_broadcast_is_received_in_a_callback_that_waits(node: Node, context: Context) -> None:
    """One thread spins the node: while its callback waits, no other callback runs."""
    from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener

    buffer = Buffer()
    TransformListener(buffer, node)
    other = Node("other", context=context)
    fixed, moving = StaticTransformBroadcaster(other), TransformBroadcaster(other)
    found: list[Any] = []

    waits = threading.Event()

    def look() -> None:
        timer.cancel()
        waits.set()
        found.append(buffer.lookup_transform("odom", "laser", at(5.0), Duration(seconds=20)))

    timer = node.create_timer(0.01, look)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    thread = threading.Thread(target=lambda: executor.spin_once(timeout_sec=20))
    thread.start()
    assert waits.wait(20)
    fixed.sendTransform(stamped("base", "camera", plain(1.0)))
    fixed.sendTransform([stamped("base", "laser", plain(0.5))])
    moving.sendTransform(stamped("odom", "base", plain(2.0), 5.0))
    thread.join(30)
    while not found:
        executor.spin_once(timeout_sec=5)
    assert found[0].transform.translation.x == pytest.approx(2.5)
    assert buffer.can_transform("laser", "camera", Time()), "what was sent first is still said"
    executor.shutdown()
    other.destroy_node()


def test_in_lockstep_it_does_not_wait_for_a_time_that_cannot_come(
    node: Node, context: Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    from tf2_ros import Buffer, LookupException, TransformListener

    executor = DrainingExecutor(context=context)
    executor.add_node(node)
    buffer = Buffer()
    TransformListener(buffer, node)
    waits: list[float] = []
    monkeypatch.setattr("time.sleep", waits.append)
    with pytest.raises(LookupException):
        buffer.lookup_transform("odom", "base", Time(), Duration(seconds=3600))
    assert waits == []
    executor.shutdown()


def test_a_listener_with_a_thread_needs_no_spinning(node: Node, context: Context) -> None:
    from tf2_ros import Buffer, TransformBroadcaster, TransformListener

    buffer = Buffer()
    listener = TransformListener(buffer, node, spin_thread=True)
    other = Node("other", context=context)
    TransformBroadcaster(other).sendTransform(stamped("odom", "base", plain(2.0)))
    assert buffer.can_transform("odom", "base", Time(), Duration(seconds=20))
    listener.unregister()
    other.destroy_node()


def test_a_future_gets_the_transform_once_it_is_there(node: Node) -> None:
    from tf2_ros import Buffer

    buffer = Buffer(node=node)
    future = buffer.wait_for_transform_async("odom", "base", Time())
    assert not future.done()
    buffer.set_transform(stamped("odom", "base", plain(2.0)), "test")
    assert future.done()
    assert future.result().transform.translation.x == pytest.approx(2.0)


def test_frames_are_reported_by_a_service(node: Node, context: Context) -> None:
    from tf2_msgs.srv import FrameGraph
    from tf2_ros import Buffer

    buffer = Buffer(node=node)
    buffer.set_transform(stamped("odom", "base", plain(2.0)), "me")
    client = node.create_client(FrameGraph, "tf2_frames")
    assert client.wait_for_service(20)
    answer = client.call_async(FrameGraph.Request())
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.spin_until_future_complete(answer, 20)
    assert "parent: 'odom'" in answer.result().frame_yaml
    executor.shutdown()
