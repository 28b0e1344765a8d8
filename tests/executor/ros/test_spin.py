"""Draining calls everything that is ready, of every kind, and nothing else."""

from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
from rclpy.context import Context
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

from executor.ros.spin import LOOK_EVERY, MOST_CALLS, DrainingExecutor
from tests.domains import own_domain_id


@pytest.fixture
def node() -> Iterator[Node]:
    context = Context()
    rclpy.init(context=context, domain_id=own_domain_id())
    made = Node("spun", context=context)
    yield made
    made.destroy_node()
    context.try_shutdown()


@pytest.fixture
def executor(node: Node) -> Iterator[DrainingExecutor]:
    made = DrainingExecutor(context=node.context)
    made.add_node(node)
    made.drain()
    yield made
    made.shutdown()


def test_messages_come_in_their_order_and_all_of_them(node: Node, executor: DrainingExecutor) -> None:
    heard: list[int] = []
    node.create_subscription(Int32, "numbers", lambda message: heard.append(message.data), 10)
    publisher = node.create_publisher(Int32, "numbers", 10)
    for number in range(5):
        publisher.publish(Int32(data=number))
    assert executor.drain() == 5
    assert heard == [0, 1, 2, 3, 4]
    assert executor.drain() == 0


def test_messages_published_in_a_callback_are_delivered_too(node: Node, executor: DrainingExecutor) -> None:
    heard: list[int] = []
    further = node.create_publisher(Int32, "second", 10)
    node.create_subscription(Int32, "second", lambda message: heard.append(message.data), 10)
    node.create_subscription(Int32, "first", further.publish, 10)
    node.create_publisher(Int32, "first", 10).publish(Int32(data=7))
    executor.drain()
    assert heard == [7]


def test_callbacks_with_message_info_and_coroutines_are_called(
    node: Node, executor: DrainingExecutor
) -> None:
    heard: list[str] = []

    def informed(message: Int32, info: dict[str, int]) -> None:
        heard.append(f"info {message.data} {'source_timestamp' in info}")

    async def slow(message: Int32) -> None:
        heard.append(f"coroutine {message.data}")

    node.create_subscription(Int32, "numbers", informed, 10)
    node.create_subscription(Int32, "numbers", slow, 10)
    node.create_publisher(Int32, "numbers", 10).publish(Int32(data=3))
    executor.drain()
    assert sorted(heard) == ["coroutine 3", "info 3 True"]


def test_timers_services_and_guards_are_called(node: Node, executor: DrainingExecutor) -> None:
    heard: list[str] = []

    def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        heard.append("service")
        response.success = True
        return response

    node.create_service(Trigger, "ask", answer)
    client = node.create_client(Trigger, "ask")
    assert client.wait_for_service(5)
    answered = client.call_async(Trigger.Request())
    node.create_guard_condition(lambda: heard.append("guard")).trigger()
    timer: Any = node.create_timer(0.0, lambda: (heard.append("timer"), timer.cancel()))
    for _ in range(200):  # the middleware delivers answers separately
        executor.drain()
        if answered.done():
            break
    assert sorted(heard) == ["guard", "service", "timer"]
    assert answered.result().success


def test_an_exception_of_a_callback_is_raised(node: Node, executor: DrainingExecutor) -> None:
    def fail(_: Int32) -> None:
        raise ValueError("not this one")

    node.create_subscription(Int32, "numbers", fail, 10)
    node.create_publisher(Int32, "numbers", 10).publish(Int32())
    with pytest.raises(ValueError, match="not this one"):
        executor.drain()


def test_callbacks_that_go_round_in_a_circle_end(node: Node, executor: DrainingExecutor) -> None:
    publisher = node.create_publisher(Int32, "round", 10)
    node.create_subscription(Int32, "round", publisher.publish, 10)
    publisher.publish(Int32())
    assert executor.drain() == MOST_CALLS


def test_a_subscription_that_another_callback_destroys_is_left_out(
    node: Node, executor: DrainingExecutor
) -> None:
    heard: list[int] = []
    kept: list[object] = []

    def destroy(_: Int32) -> None:
        node.destroy_subscription(kept.pop())

    node.create_subscription(Int32, "numbers", destroy, 10)
    kept.append(node.create_subscription(Int32, "numbers", lambda message: heard.append(message.data), 10))
    node.create_publisher(Int32, "numbers", 10).publish(Int32())
    executor.drain()
    assert heard == []


def test_events_of_the_middleware_are_polled_sometimes(node: Node, executor: DrainingExecutor) -> None:
    waits: list[float] = []
    wait = executor.wait_for_ready_callbacks

    def count(timeout_sec: float) -> object:
        waits.append(timeout_sec)
        return wait(timeout_sec=timeout_sec)

    executor.wait_for_ready_callbacks = count
    for _ in range(2 * LOOK_EVERY):
        executor.drain()
    assert len(waits) == 2
