"""The executor of applications waits for all kinds of entities, and calls them as rclpy's own does."""

import threading
from collections.abc import Callable, Iterator
from typing import Any

import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Int32
from std_srvs.srv import Trigger

from executor.ros.spin import LOOK_EVERY, PatientExecutor
from tests.domains import own_domain_id

LONG_S = 20.0  # the test's time-out detects a missing wake-up


@pytest.fixture
def node() -> Iterator[Node]:
    context = Context()
    rclpy.init(context=context, domain_id=own_domain_id())
    made = Node("spun", context=context)
    yield made
    made.destroy_node()
    context.try_shutdown()


@pytest.fixture
def executor(node: Node) -> Iterator[PatientExecutor]:
    made = PatientExecutor(context=node.context)
    made.add_node(node)
    for _ in range(3):
        made.spin_once(0)
    yield made
    made.shutdown()


def spin_until(executor: PatientExecutor, done: Callable[[], bool]) -> None:
    for _ in range(1000):
        if done():
            return
        executor.spin_once(0.05)
    pytest.fail("what was waited for did not come")


def test_all_kinds_are_called_in_any_of_many_waits(node: Node, executor: PatientExecutor) -> None:
    heard: list[str] = []

    def answer(_: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        heard.append("service")
        return response

    async def slow(_: Int32) -> None:
        heard.append("coroutine")

    node.create_service(Trigger, "ask", answer)
    client = node.create_client(Trigger, "ask")
    node.create_subscription(Int32, "numbers", lambda _: heard.append("plain"), 10)
    node.create_subscription(Int32, "numbers", lambda _, info: heard.append("informed"), 10)
    node.create_subscription(Int32, "numbers", slow, 10)
    publisher = node.create_publisher(Int32, "numbers", 10)
    assert client.wait_for_service(5)
    wanted = ["answer", "coroutine", "informed", "plain", "service", "timer"]
    timer: Any = node.create_timer(0.0, lambda: (heard.append("timer"), timer.cancel()))
    for _ in range(LOOK_EVERY):
        heard.clear()
        timer.reset()
        client.call_async(Trigger.Request()).add_done_callback(lambda _: heard.append("answer"))
        publisher.publish(Int32())
        spin_until(executor, lambda: len(heard) >= len(wanted))
        assert sorted(heard) == wanted


def test_a_guard_condition_is_called(node: Node, executor: PatientExecutor) -> None:
    heard: list[str] = []
    node.create_guard_condition(lambda: heard.append("guard")).trigger()
    spin_until(executor, lambda: heard == ["guard"])


def test_an_exception_of_a_callback_is_raised_and_spinning_continues(
    node: Node, executor: PatientExecutor
) -> None:
    heard: list[int] = []

    def fail(message: Int32) -> None:
        heard.append(message.data)
        raise ValueError("not this one")

    node.create_subscription(Int32, "numbers", fail, 10)
    publisher = node.create_publisher(Int32, "numbers", 10)
    for number in range(3):
        publisher.publish(Int32(data=number))
        with pytest.raises(ValueError, match="not this one"):
            spin_until(executor, lambda: False)
    assert heard == [0, 1, 2]


def test_a_callback_that_spins_is_not_reentered(node: Node, executor: PatientExecutor) -> None:
    heard: list[int] = []

    def nested(message: Int32) -> None:
        heard.append(message.data)
        executor.spin_once(0.01)
        heard.append(-message.data)

    node.create_subscription(Int32, "numbers", nested, 10)
    publisher = node.create_publisher(Int32, "numbers", 10)
    publisher.publish(Int32(data=1))
    publisher.publish(Int32(data=2))
    spin_until(executor, lambda: len(heard) == 4)
    assert heard == [1, -1, 2, -2]


def test_another_thread_ends_a_wait(executor: PatientExecutor) -> None:
    waker = threading.Timer(0.1, executor.wake)
    waker.start()
    executor.spin_once(LONG_S)
    waker.join()


def test_the_end_of_the_context_ends_a_wait(node: Node, executor: PatientExecutor) -> None:
    ender = threading.Timer(0.1, node.context.try_shutdown)
    ender.start()
    with pytest.raises(ExternalShutdownException):
        executor.spin_once(LONG_S)
    ender.join()
