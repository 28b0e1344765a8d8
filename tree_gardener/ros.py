"""Runs a tree on an rclpy node, by ROS time, which is simulated time under ``use_sim_time``."""

import time
from collections.abc import Callable
from typing import Any

import tree_gardener.ros_wheels  # noqa: F401 - refuses two ROS before rclpy is loaded

from tree_gardener.errors import TickError, in_full
from tree_gardener.node import Node
from tree_gardener.runner import Overrun, Runner
from tree_gardener.status import Status
from tree_gardener.tree import Tree

NANOSECONDS = 1_000_000_000


class RosClock:
    """The time of an rclpy node."""

    def __init__(self, node: Any) -> None:
        self._clock = node.get_clock()

    def now(self) -> float:
        """Returns the ROS time in seconds."""
        return float(self._clock.now().nanoseconds) / NANOSECONDS

    def sleep(self, duration_s: float) -> None:
        """Waits for this much ROS time; must not be called from a callback of the node that spins."""
        end_s = self.now() + duration_s
        while self.now() < end_s:
            time.sleep(min(0.001, duration_s))


class RosRunner:
    """Ticks a tree from a timer of an rclpy node, once per period of ROS time.

    All publishers and subscriptions of the actions live on that node, so that spinning it runs everything.
    Where it is an `ActionNode`, halting the tree commands zero where the run has commanded motion.

    Args:
        tree: made with ``clock=RosClock(node)``.
        node: the rclpy node; it is handed to ``setup`` of each action.
        tick_hz: the number of ticks per second.
        finished: called with the root's last status when the run ends by itself.
        callback_group: the callback group of the timer; by default a separate one, so that an action may spin
            the node within a tick.
        is_set_up: whether the tree's `setup` was called already.
        more: further arguments of `Runner`.
    """

    def __init__(  # noqa: PLR0913 - all by keyword
        self,
        tree: Tree,
        node: Any,
        *,
        tick_hz: float,
        finished: Callable[[Status], None] | None = None,
        callback_group: Any = None,
        is_set_up: bool = False,
        **more: Any,
    ) -> None:
        from rclpy.callback_groups import MutuallyExclusiveCallbackGroup  # noqa: PLC0415 - as needed here

        self._node = node
        self._clock = RosClock(node)
        self._log = node.get_logger()
        more.setdefault("fault", self._log_fault)
        more.setdefault("overrun", self._log_overrun)
        commanded = getattr(node, "commanded", None)
        if commanded is not None:
            commanded.begin()
            more.setdefault("halted", commanded.stop)
        tree.on_warning = self._log_warning
        if not is_set_up:
            tree.setup(node=node)
        self.runner = Runner(tree, tick_hz=tick_hz, finished=finished, **more)
        # Polls several times in each period: the runner itself decides when a tick is due, so that the rate
        # can change.
        group = callback_group or MutuallyExclusiveCallbackGroup()
        self._timer = node.create_timer(self.runner.period_s / 4.0, self.poll, callback_group=group)

    def poll(self) -> None:
        """Ticks if a tick is due."""
        self.runner.tick_due(self._clock.now())

    def stop(self) -> None:
        """Halts the tree and ends the timer; the tree may run again later."""
        self._node.destroy_timer(self._timer)
        self.runner.stop()

    def fail(self, error: BaseException) -> None:
        """Ends the run after an exception outside of a tick, such as that of a callback."""
        self.runner.fail(error)

    def shutdown(self) -> None:
        """Halts the tree, which stops the robot, and ends the timer; logs what an action raises then."""
        self._node.destroy_timer(self._timer)
        try:
            self.runner.shutdown()
        except TickError as error:
            self._log_fault(error)

    def _log_fault(self, error: TickError) -> None:
        self._log.error(in_full(error))

    def _log_warning(self, node: Node, message: str) -> None:
        self._log.warning(f"node '{node.path}': {message}")

    def _log_overrun(self, overrun: Overrun) -> None:
        tree = self.runner.tree
        slow = (
            f", of which {tree.nodes[overrun.slow_uid - 1].path} {overrun.slow_s:.3f} s"
            if overrun.slow_uid
            else ""
        )
        self._log.warning(
            f"tick {overrun.tick} took {overrun.duration_s:.3f} s of {overrun.period_s:.3f} s{slow}"
        )
