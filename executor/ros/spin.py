"""Single-threaded executors that are cheaper than rclpy's: they read messages without a full wait set."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, Final

from rclpy.event_handler import EventHandler
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor, TimeoutException
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.subscription import Subscription

if TYPE_CHECKING:
    from collections.abc import Iterable

    from rclpy.node import Node

MOST_CALLS: Final = 1000
_KINDS: Final = ("subscriptions", "timers", "clients", "services")
LOOK_EVERY: Final = 50
"""Number of drains or waits after which events of the middleware (such as QoS errors) are handled."""


class PatientExecutor(SingleThreadedExecutor):  # type: ignore[misc]
    """Waits for messages and calls their callbacks.

    For each wait, rclpy's own executor creates a timer, a wait set of all entities of a node, and a task;
    that costs more than most callbacks. This executor handles plain subscriptions itself; all other entities
    only end the wait, and rclpy then handles them.
    """

    _waits = 0

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Calls the callbacks that are ready, each at most once, or waits for one.

        An exception of a callback is raised here.
        """
        self._waits += 1
        nodes = list(self.get_nodes())
        goes_on = any(not task.done() for task, _, _ in self._tasks)
        if goes_on or self._waits % LOOK_EVERY == 0 or any(map(_has_more_to_wait_for, nodes)):
            super().spin_once(timeout_sec)
            return
        plain, others = self._wait(nodes, timeout_sec)
        for subscription in plain:
            group = subscription.callback_group
            if group.beginning_execution(subscription):
                try:
                    _call_once(subscription)
                finally:
                    group.ending_execution(subscription)
        if others:
            self._cb_iter = None  # entities left over from the last wait are still ready
            super().spin_once(0)

    def _wait(self, nodes: list[Node], timeout_s: float | None) -> tuple[list[Subscription], bool]:
        """Waits; returns the plain subscriptions that are ready, and whether any other entity is ready."""
        held: list[Any] = []
        try:
            subscriptions, timers, clients, services = (
                [one for node in nodes for one in self._holding(node, kind, held)] for kind in _KINDS
            )
            guards = _hold((self._guard, self._sigint_gc), held)
            counts = len(subscriptions), len(guards), len(timers), len(clients), len(services)
            context = self._context.handle
            context.__enter__()
            held.append(context)
            waits = rclpy_implementation.WaitSet(*counts, 0, context)
            waits.clear_entities()
            for add, things in (
                (waits.add_subscription, subscriptions),
                (waits.add_guard_condition, guards),
                (waits.add_timer, timers),
                (waits.add_client, clients),
                (waits.add_service, services),
            ):
                for thing in things:
                    add(thing.handle)
            waits.wait(-1 if timeout_s is None else round(timeout_s * 1e9))
            if not self._context.ok():
                raise ExternalShutdownException
            ready = set(waits.get_ready_entities("subscription"))
            heard = [one for one in subscriptions if one.handle.pointer in ready]
            others = any(map(waits.get_ready_entities, ("timer", "client", "service")))
        finally:
            for handle in held:
                handle.__exit__(None, None, None)
        plain = [one for one in heard if _is_plain(one)]
        return plain, others or len(plain) < len(heard)

    def _holding(self, node: Node, kind: str, held: list[Any]) -> list[Any]:
        return _hold((one for one in getattr(node, kind) if self.can_execute(one)), held)


class DrainingExecutor(SingleThreadedExecutor):  # type: ignore[misc]
    """The executor of lock-step runs: `drain` delivers all messages published earlier in this process."""

    holds_time = True
    """No time passes during a callback, so waiting in one is pointless."""

    _drains = 0

    def drain(self) -> int:
        """Calls the callbacks that are ready; returns their number.

        An exception of a callback is raised here. At most `MOST_CALLS` are called, since callbacks may make
        others ready endlessly.
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
        """Calls the callbacks of plain subscriptions; returns their number.

        Reading a message costs a tenth of a wait set.
        """
        calls = 0
        for node in self.get_nodes():
            for subscription in list(node.subscriptions):
                if calls < most and _is_plain(subscription) and self.can_execute(subscription):
                    calls += _call_once(subscription)
        return calls

    def _may_have_more(self) -> bool:
        """Returns whether other entities could be ready, which only a wait set shows."""
        if self._tasks:
            return True
        return any(_has_more(node) for node in self.get_nodes())


def _hold(things: Iterable[Any], held: list[Any]) -> list[Any]:
    """Protects entities from destruction, by holding their handles in `held`.

    Returns those that still exist.
    """
    found = []
    for thing in things:
        handle = thing.handle
        try:
            handle.__enter__()
        except rclpy_implementation.InvalidHandle:  # the entity was destroyed meanwhile
            continue
        held.append(handle)
        found.append(thing)
    return found


def _is_plain(subscription: Subscription) -> bool:
    is_simple = subscription._callback_type is Subscription.CallbackType.MessageOnly
    return is_simple and not inspect.iscoroutinefunction(subscription.callback)


def _call_once(subscription: Subscription) -> int:
    """Reads the next message of a subscription and calls its callback.

    Returns the number of calls, 0 or 1.
    """
    try:
        with subscription.handle:
            taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
    except rclpy_implementation.InvalidHandle:  # an earlier callback destroyed the subscription
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


def _has_more_to_wait_for(node: Node) -> bool:
    if any(True for _ in node.guards):
        return True
    return any(not isinstance(waitable, EventHandler) for waitable in node.waitables)


def _finish(handler: Any) -> None:
    handler()
    if handler.exception() is not None:
        raise handler.exception()
