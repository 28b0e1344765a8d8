"""rclpy's default context, opened for the actions of one run."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import rclpy
from rclpy import utilities
from rclpy.context import Context
from rclpy.signals import SignalHandlerOptions

from tree_gardener.ros_node import guard_rclpy

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["DefaultContext"]

SIMULATED: Final = ("--ros-args", "-p", "use_sim_time:=true")


class DefaultContext:
    """Replaces rclpy's default context by a new one, until `close`.

    Args:
        domain_id: the domain of the ROS graph; with None, the domain that the environment names.
        simulated: whether nodes that actions create use simulated time, as the run's own node does.
    """

    def __init__(self, domain_id: int | None = None, *, simulated: bool) -> None:
        self._before: Any = utilities.g_default_context
        self.context = utilities.g_default_context = Context()
        options = SignalHandlerOptions.NO
        rclpy.init(
            args=list(SIMULATED if simulated else ()), domain_id=domain_id, signal_handler_options=options
        )
        self._end_guard: Callable[[], None] = guard_rclpy()

    def close(self) -> None:
        """Ends the context: `rclpy.ok()` is false from now on."""
        self._end_guard()
        self.context.try_shutdown()
        utilities.g_default_context = self._before
