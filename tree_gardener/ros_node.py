"""Adapts rclpy for actions: they share one node, and a default context that the run has initialized.

Tutorials use `rclpy.init()`, `rclpy.spin_once(node)` and `rclpy.ok()`; these work in an action too. Calls
that would end ROS for the rest of the tree (`rclpy.shutdown()`, `node.destroy_node()`) raise an error with
the reason.
"""

import contextlib
import threading
import weakref
from collections.abc import Callable, Iterator
from typing import Any, Final

import tree_gardener.ros_wheels  # noqa: F401 - refuses two ROS before rclpy is loaded

import rclpy
import rclpy.utilities
from rcl_interfaces.msg import SetParametersResult
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future

from tree_gardener.callbacks import owned
from tree_gardener.errors import TickError
from tree_gardener.ros_commanded import Commanded

__all__ = ["ActionNode", "MainThreadGroup", "guard_rclpy"]

NO_SHUTDOWN: Final = (
    "rclpy.shutdown() would end ROS for the whole tree: leave it out, the run shuts rclpy down when it ends"
)
UNANSWERED: Final = object()
"""Returned in place of the response of a service whose callback raised."""
NO_DESTROY: Final = (
    "node.destroy_node() would take the node from the whole tree: "
    "destroy what the action made, with node.destroy_subscription(…) and the like"
)


class ActionNode(Node):
    """A node that stays with the executor that it was added to first, even if another one spins it.

    `rclpy.spin_once(node)` adds a node to another executor for a moment and would leave it without any.

    The callbacks that an action gives it belong to that action (`tree_gardener.callbacks`).

    Attributes:
        commanded: the topics on which it has commanded motion.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        self.commanded = Commanded(self)
        self._first: weakref.ref[Any] | None = None
        self._spinners: weakref.WeakSet[Any] = weakref.WeakSet()
        self._is_over = False
        super().__init__(*arguments, **options)

    @property
    def executor(self) -> Any:
        """The executor of the run."""
        return None if self._first is None else self._first()

    @executor.setter
    def executor(self, executor: Any) -> None:
        if executor is not None:
            self._spinners.add(executor)
            if self.executor is None:
                self._first = weakref.ref(executor)

    def _wake_executor(self) -> None:
        for executor in list(self._spinners):
            executor.wake()

    def create_subscription(
        self, msg_type: Any, topic: str, callback: Any, *arguments: Any, **options: Any
    ) -> Any:
        """Makes a subscription, as rclpy does.

        Raises:
            TypeError: this process uses the topic with another type.
        """
        with self._other_type_named(msg_type, topic):
            return super().create_subscription(msg_type, topic, owned(callback), *arguments, **options)

    def create_publisher(self, msg_type: Any, topic: str, *arguments: Any, **options: Any) -> Any:
        """Makes a publisher, as rclpy does.

        Raises:
            TypeError: this process uses the topic with another type.
        """
        with self._other_type_named(msg_type, topic):
            publisher = super().create_publisher(msg_type, topic, *arguments, **options)
        self.commanded.watch(publisher)
        return publisher

    def create_timer(self, timer_period_sec: float, callback: Any, *arguments: Any, **options: Any) -> Any:
        """Makes a timer, as rclpy does."""
        return super().create_timer(timer_period_sec, owned(callback), *arguments, **options)

    def create_guard_condition(self, callback: Any, *arguments: Any, **options: Any) -> Any:
        """Makes a guard condition, as rclpy does."""
        return super().create_guard_condition(owned(callback), *arguments, **options)

    def create_service(
        self, srv_type: Any, srv_name: str, callback: Any, *arguments: Any, **options: Any
    ) -> Any:
        """Makes a service, as rclpy does; a request whose callback raises has no answer."""
        guarded = owned(callback, lambda _: UNANSWERED)
        service = super().create_service(srv_type, srv_name, guarded, *arguments, **options)
        if guarded is not callback:
            send = service.send_response
            service.send_response = lambda response, header: (
                None if response is UNANSWERED else send(response, header)
            )
        return service

    def add_on_set_parameters_callback(self, callback: Any) -> None:
        """Adds a callback, as rclpy does; one that raises refuses the parameters."""
        super().add_on_set_parameters_callback(owned(callback, _refusal))

    def add_pre_set_parameters_callback(self, callback: Any) -> None:
        """Adds a callback, as rclpy does; one that raises sets no parameter."""
        super().add_pre_set_parameters_callback(owned(callback, lambda _: []))

    def add_post_set_parameters_callback(self, callback: Any) -> None:
        """Adds a callback, as rclpy does."""
        super().add_post_set_parameters_callback(owned(callback))

    def add_waitable(self, waitable: Any) -> None:
        """Adds a waitable, as rclpy does, such as a client of an action with its feedback."""
        execute = waitable.execute
        guarded = owned(execute)
        if guarded is not execute:
            waitable.execute = guarded
        super().add_waitable(waitable)

    @contextlib.contextmanager
    def _other_type_named(self, msg_type: Any, topic: str) -> Iterator[None]:
        """Explains rcl's "invalid allocator": a participant cannot use one topic with two types."""
        try:
            yield
        except RuntimeError:  # RCLError
            name = self.resolve_topic_name(topic)
            there = dict(self.get_topic_names_and_types()).get(name, [])
            wanted = f"{msg_type.__module__.split('.')[0]}/msg/{msg_type.__name__}"
            if not there or wanted in there:
                raise
            text = f"{name} is of the type {there[0]}, not {wanted}: use the same message type at both ends"
            raise TypeError(text) from None

    def destroy_node(self) -> None:
        """Refuses: an action must not destroy the shared node.

        Raises:
            RuntimeError: always, before `close`.
        """
        if not self._is_over:
            raise RuntimeError(NO_DESTROY)
        super().destroy_node()

    def close(self) -> None:
        """Leaves the ROS graph at the end of the run."""
        self._is_over = True
        self.destroy_node()


def _refusal(error: TickError) -> SetParametersResult:
    return SetParametersResult(successful=False, reason=str(error))


class MainThreadGroup(MutuallyExclusiveCallbackGroup):
    """Runs callbacks on the main thread only: no tick runs in a thread where an action spins its node."""

    def can_execute(self, entity: Any) -> bool:
        """Returns whether the callback may run now, in this thread."""
        return threading.current_thread() is threading.main_thread() and bool(super().can_execute(entity))


def guard_rclpy() -> Callable[[], None]:
    """Makes the run's open context rclpy's default one; returns the function that reverts this.

    `rclpy.init()` does nothing then, and `rclpy.shutdown()` raises. What an action adds to a future
    belongs to it.
    """
    names = ("init", "shutdown", "try_shutdown")
    before = [
        (module, name, getattr(module, name))
        for module in (rclpy, rclpy.utilities)
        for name in names
        if hasattr(module, name)
    ]
    real_init = rclpy.init

    def init(*, context: Any = None, **options: Any) -> None:
        if context is not None and context is not rclpy.utilities.get_default_context():
            real_init(context=context, **options)

    def ending(real: Callable[..., None]) -> Callable[..., None]:
        def end(*, context: Any = None, **options: Any) -> None:
            if context is None or context is rclpy.utilities.get_default_context():
                raise RuntimeError(NO_SHUTDOWN)
            real(context=context, **options)

        return end

    for module, name, real in before:
        setattr(module, name, init if name == "init" else ending(real))
    add = Future.add_done_callback

    def add_owned(future: Any, callback: Any) -> None:
        add(future, owned(callback))

    Future.add_done_callback = add_owned

    def restore() -> None:
        Future.add_done_callback = add
        for module, name, real in before:
            setattr(module, name, real)

    return restore
