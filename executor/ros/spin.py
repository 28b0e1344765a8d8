"""An executor that calls all that is ready, and returns when nothing is."""

from __future__ import annotations

from typing import Any, Final

from rclpy.executors import SingleThreadedExecutor, TimeoutException

MOST_CALLS: Final = 1000


class DrainingExecutor(SingleThreadedExecutor):  # type: ignore[misc]
    """For lock-step: what was published in this process before `drain` is called back within it."""

    def drain(self) -> int:
        """Calls what is ready; returns how many callbacks that were.

        A callback's exception is raised here. Callbacks that make others ready without end are left at
        `MOST_CALLS`.
        """
        for calls in range(MOST_CALLS):
            try:
                handler, _, _ = self.wait_for_ready_callbacks(timeout_sec=0)
            except TimeoutException:
                return calls
            _finish(handler)
        return MOST_CALLS


def _finish(handler: Any) -> None:
    handler()
    if handler.exception() is not None:
        raise handler.exception()
