"""Spinning a program's node: exceptions of callbacks, signals, and the answers to cancelled goals."""

from __future__ import annotations

import os
import signal
import threading
from typing import TYPE_CHECKING

import pytest
import rclpy
from rclpy.action import ActionClient
from rclpy.signals import SignalHandlerOptions
from rclpy.task import Future
from tf2_msgs.action import LookupTransform

from tests.domains import own_domain_id
from tree_gardener import ros_spinning
from tree_gardener.ros_node import ActionNode
from tree_gardener.ros_spinning import handled_signals, spinning

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")


@pytest.fixture
def node() -> Iterator[ActionNode]:
    rclpy.init(domain_id=own_domain_id(), signal_handler_options=SignalHandlerOptions.NO)
    made = ActionNode("spun")
    yield made
    made.close()
    rclpy.try_shutdown()


def fail() -> None:
    raise ValueError("no arm")


def test_an_exception_of_a_callback_or_of_a_step_is_handed_on(node: ActionNode) -> None:
    heard: list[BaseException] = []
    with spinning(node, threading.Event()) as spinner:
        spinner.broken = heard.append
        timer = node.create_timer(0.001, fail)
        while not heard:
            assert spinner.once()
        node.destroy_timer(timer)
        heard.clear()
        assert spinner.once(fail)
    assert [str(error) for error in heard] == ["no arm"]
    assert spinner.error is None


@pytest.mark.parametrize("is_taken", [True, False])
def test_what_nothing_takes_ends_the_program(node: ActionNode, is_taken: bool) -> None:
    with spinning(node, threading.Event()) as spinner:
        spinner.broken = spinner.unless(lambda _: is_taken)
        assert spinner.once(fail) is is_taken
    assert (spinner.error is None) is is_taken


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_program_in_order_and_a_second_one_changes_nothing(
    node: ActionNode, number: signal.Signals
) -> None:
    before = signal.getsignal(number)
    with handled_signals() as stop:
        with spinning(node, stop) as spinner:
            os.kill(os.getpid(), number)
            while spinner.once():
                pass
        os.kill(os.getpid(), number)
    assert signal.getsignal(number) is before


def test_the_answers_to_cancelled_goals_are_awaited(node: ActionNode) -> None:
    pending = ActionClient(node, LookupTransform, "look")._pending_cancel_requests
    pending[1] = Future()
    with spinning(node, threading.Event()) as spinner:
        node.create_timer(0.001, pending.clear)
        spinner.await_answers()
    assert pending == {}


def test_a_server_that_does_not_answer_is_awaited_for_a_short_time(
    node: ActionNode, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ros_spinning, "ANSWERS_S", 0.0)
    pending = ActionClient(node, LookupTransform, "look")._pending_goal_requests
    pending[1] = Future()
    with spinning(node, threading.Event()) as spinner:
        spinner.await_answers()
    assert list(pending) == [1]
