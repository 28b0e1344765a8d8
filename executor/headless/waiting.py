"""Waits of actions in lock-step: simulated time passes while an action waits in rclpy."""

from __future__ import annotations

import threading
from functools import partialmethod
from typing import TYPE_CHECKING, Any

from rclpy.executors import Executor, TimeoutException, TimeoutObject

from executor.ros.spin import DrainingExecutor

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    Condition = Callable[[], bool]

__all__ = ["wait_in_simulation"]


def wait_in_simulation(now_s: Callable[[], float], advance: Callable[[], None]) -> Callable[[], None]:
    """Makes waits of rclpy's executors on the main thread advance the simulation; returns the undo function.

    Args:
        now_s: returns the simulated time in s.
        advance: simulates a short time; raises an exception after the end of the run.
    """
    waits = _Waits(now_s, advance)
    Executor._wait_for_ready_callbacks = partialmethod(_call, waits.wait)
    Executor.spin_until_future_complete = partialmethod(_call, waits.spin_until)

    def restore() -> None:
        Executor._wait_for_ready_callbacks = waits.real_wait
        Executor.spin_until_future_complete = waits.real_spin

    return restore


def _call(executor: Any, method: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
    return method(executor, *arguments, **options)


class _Waits:
    """Replaces two methods of rclpy's executors."""

    def __init__(self, now_s: Callable[[], float], advance: Callable[[], None]) -> None:
        self._now_s = now_s
        self._advance = advance
        self.real_wait: Any = Executor._wait_for_ready_callbacks
        self.real_spin: Any = Executor.spin_until_future_complete

    def wait(
        self, executor: Any, timeout_sec: Any = None, nodes: Any = None, condition: Condition = lambda: False
    ) -> Iterator[Any]:
        """Yields ready callbacks; if none is ready, simulates until one is, or until the timeout."""
        if _is_foreign(executor):
            yield from self.real_wait(executor, timeout_sec, nodes, condition)
            return
        end_s = _end(self._now_s(), timeout_sec)
        while True:
            found = False
            try:
                for ready in self.real_wait(executor, 0.0, nodes, condition):
                    found = True
                    yield ready
            except TimeoutException:
                if not found and self._is_over(end_s):
                    raise
            if found or condition():
                return
            self._advance()

    def spin_until(self, executor: Any, future: Any, timeout_sec: float | None = None) -> None:
        """Spins until a future is done, or until the timeout in simulated seconds."""
        if _is_foreign(executor):
            self.real_spin(executor, future, timeout_sec)
            return
        end_s = _end(self._now_s(), timeout_sec)
        while executor.context.ok() and not future.done() and not future.cancelled():
            left_s = None if end_s is None else max(end_s - self._now_s(), 0.0)
            executor.spin_once_until_future_complete(future, left_s)
            if self._is_over(end_s):
                return

    def _is_over(self, end_s: float | None) -> bool:
        return end_s is not None and self._now_s() >= end_s - 1e-9


def _is_foreign(executor: Any) -> bool:
    """Returns whether the wait is not an action's: the run itself waits, or a thread other than the main."""
    return isinstance(executor, DrainingExecutor) or threading.current_thread() is not threading.main_thread()


def _end(now_s: float, timeout: Any) -> float | None:
    timeout_s = timeout.timeout if isinstance(timeout, TimeoutObject) else timeout
    return None if timeout_s is None or timeout_s < 0 else now_s + float(timeout_s)
