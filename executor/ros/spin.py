"""An executor that calls all that is ready, and returns when nothing is."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, Final

from rclpy.event_handler import EventHandler
from rclpy.executors import SingleThreadedExecutor, TimeoutException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.subscription import Subscription

if TYPE_CHECKING:
    from rclpy.node import Node

MOST_CALLS: Final = 1000
LOOK_EVERY: Final = 50
"""Notices of the middleware (of a wrong QoS, say) may wait for so many drains."""


class DrainingExecutor(SingleThreadedExecutor):  # type: ignore[misc]
    """For lock-step: what was published in this process before `drain` is called back within it."""

    _drains = 0

    def drain(self) -> int:
        """Calls what is ready; returns how many callbacks that were.

        A callback's exception is raised here. Callbacks that make others ready without end are left at
        `MOST_CALLS`.
        """
        calls = 0
        look = self._drains % LOOK_EVERY == 0
        self._drains += 1
        while calls < MOST_CALLS:
            called = self._call_subscriptions(MOST_CALLS - calls)
            calls += called
            if not called:
                if not look and not self._may_have_more():
                    break
                try:
                    handler, _, _ = self.wait_for_ready_callbacks(timeout_sec=0)
                except TimeoutException:
                    break
                _finish(handler)
                calls += 1
        return calls

    def _call_subscriptions(self, most: int) -> int:
        """Calls back plain subscriptions: taking a message costs a tenth of a wait set."""
        calls = 0
        for node in self.get_nodes():
            for subscription in list(node.subscriptions):
                if calls < most and _is_plain(subscription) and self.can_execute(subscription):
                    calls += _call_once(subscription)
        return calls

    def _may_have_more(self) -> bool:
        """Tells whether anything but subscriptions could be ready: only a wait set knows."""
        if self._tasks:
            return True
        return any(_has_more(node) for node in self.get_nodes())


def _is_plain(subscription: Subscription) -> bool:
    is_simple = subscription._callback_type is Subscription.CallbackType.MessageOnly
    return is_simple and not inspect.iscoroutinefunction(subscription.callback)


def _call_once(subscription: Subscription) -> int:
    """Takes one message, in the order in which they came, and calls back with it."""
    try:
        with subscription.handle:
            taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
    except rclpy_implementation.InvalidHandle:  # a callback before this one destroyed it
        return 0
    if taken is None:
        return 0
    subscription.callback(taken[0])
    return 1


def _has_more(node: Node) -> bool:
    timers: Any = node.timers
    if any(not timer.is_canceled() and timer.is_ready() for timer in timers):
        return True
    # Services are only called by clients, which in lock-step are in this process too.
    if any(True for _ in node.clients) or any(not _is_plain(one) for one in node.subscriptions):
        return True
    if any(True for _ in node.guards):
        return True
    return any(not isinstance(waitable, EventHandler) for waitable in node.waitables)


def _finish(handler: Any) -> None:
    handler()
    if handler.exception() is not None:
        raise handler.exception()
