"""Spins the node of an exported program until a signal, or an error, ends it."""

import contextlib
import signal
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, Final

import tree_gardener.ros_wheels  # noqa: F401 - refuses two ROS before rclpy is loaded

import rclpy
from rclpy.executors import SingleThreadedExecutor

from tree_gardener.ros_node import guard_rclpy

ENDED, NOT_STARTED, BROKEN = 0, 1, 3
"""The exit statuses: the tree ended or was stopped; the program could not start; an error ended it."""

POLL_S: Final = 0.1
CLOCK_S: Final = 5.0
ANSWERS_S: Final = 1.0
"""How long the end of a run waits for the servers whose goals were cancelled."""
LAST_ZEROS: Final = 10
"""How often the end of a program commands zero, where it has commanded motion."""


class Spinner:
    """Spins a node; exceptions of its callbacks end what runs, not the process.

    Args:
        node: the node.
        stop: set to end the program, as signals do.

    Attributes:
        stop: the same.
        broken: takes each exception of a callback.
        error: the exception that ends the program, if nothing else took it.
    """

    def __init__(self, node: Any, stop: threading.Event) -> None:
        self.stop = stop
        self.broken: Callable[[BaseException], None] = self.give_up
        self.error: BaseException | None = None
        self._node = node
        self._executor = SingleThreadedExecutor()
        self._executor.add_node(node)
        self._patience = _ClockPatience(node)

    def once(self, step: Callable[[], None] = lambda: None) -> bool:
        """Handles what is ready, or waits a moment for it, and makes a step; returns whether to continue."""
        if rclpy.ok():
            self._guarded(lambda: self._executor.spin_once(0.0 if self.stop.is_set() else POLL_S))
            self._guarded(step)
            self._patience.look()
        return bool(rclpy.ok()) and not self.stop.is_set()

    def give_up(self, error: BaseException) -> None:
        """Ends the program because of an exception that belongs to nothing that runs."""
        self.error = self.error or error
        self.stop.set()

    def unless(self, taken: Callable[[BaseException], bool]) -> Callable[[BaseException], None]:
        """Returns a function that gives the program up unless another one takes the exception."""

        def take(error: BaseException) -> None:
            if not taken(error):
                self.give_up(error)

        return take

    def await_answers(self) -> None:
        """Waits a short time for the answers of servers, after goals were cancelled."""
        end_s = time.monotonic() + ANSWERS_S
        while rclpy.ok() and any(map(_is_asked, self._node.waitables)) and time.monotonic() < end_s:
            self._guarded(lambda: self._executor.spin_once(POLL_S / 2))

    def close(self) -> None:
        """Ends the executor."""
        self._executor.shutdown()

    def _guarded(self, call: Callable[[], None]) -> None:
        try:
            call()
        except (Exception, SystemExit) as error:
            self.broken(error)


@contextlib.contextmanager
def spinning(node: Any, stop: threading.Event, cmd_timeout_s: float = 0.0) -> Iterator[Spinner]:
    """Yields what spins the node until `stop` is set.

    Topics on which the node has commanded motion stop after a time without a command; 0 for never.
    """
    end_guard = guard_rclpy()
    end_watch = node.commanded.watched(cmd_timeout_s)
    spinner = Spinner(node, stop)
    try:
        yield spinner
    finally:
        end_watch()
        end_guard()
        spinner.close()


class _ClockPatience:
    """Warns once that no simulated time arrives; the tree would wait silently otherwise."""

    def __init__(self, node: Any) -> None:
        self._node = node
        self._waits = bool(node.get_parameter("use_sim_time").value)
        self._end_s = time.monotonic() + CLOCK_S

    def look(self) -> None:
        """Checks the clock from time to time."""
        if not self._waits:
            return
        if self._node.get_clock().now().nanoseconds > 0:
            self._waits = False
        elif time.monotonic() > self._end_s:
            self._waits = False
            self._node.get_logger().warning(
                f"use_sim_time is true, but no time came on /clock in {CLOCK_S:.0f} s; the tree waits for it"
            )


def _is_asked(client: Any) -> bool:
    """Returns whether a client of an action waits for the answer to a goal, or to its end."""
    return any(getattr(client, f"_pending_{what}_requests", None) for what in ("goal", "cancel"))


@contextlib.contextmanager
def handled_signals() -> Iterator[threading.Event]:
    """Yields an event that SIGINT and SIGTERM set while the context lasts; `ros2 launch` sends some twice."""
    stop = threading.Event()
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, lambda *_: stop.set()) for number in numbers]
    try:
        yield stop
    finally:
        for number, handler in zip(numbers, before, strict=True):
            signal.signal(number, handler)
