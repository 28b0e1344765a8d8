"""The application's ROS node, which uses simulated time and is spun by the main thread."""

from __future__ import annotations

import contextlib
import time
from typing import TYPE_CHECKING, Any, Final, Protocol

from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock

from executor.ros.default_context import DefaultContext
from executor.ros.environment import ports_of_its_own
from executor.ros.shared_topics import await_commands
from executor.ros.spin import PatientExecutor
from tree_gardener.ros_node import ActionNode, MainThreadGroup

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["ApplicationGraph", "Graph"]

NODE_NAME: Final = "bt_application"
WALL_PERIOD_S: Final = 0.002
CLOCK_PROBE_S: Final = 1.5
_CLOCK_QOS: Final = QoSProfile(
    depth=1, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE
)
_OWN_TOPICS: Final = frozenset({"/clock", "/parameter_events", "/rosout"})


class ApplicationGraph(Protocol):
    """The node of an application, its time, and its waiting. It is also the clock of the tree."""

    domain_id: int

    @property
    def node(self) -> ActionNode:
        """The node of the actions."""

    def now(self) -> float:
        """Returns the simulated time in s."""

    def sleep(self, duration_s: float) -> None:
        """Waits for simulated time, where that is possible."""

    def spin_once(self, timeout_s: float) -> None:
        """Runs one callback; waits for one for at most `timeout_s`."""

    def wake(self) -> None:
        """Interrupts a wait of `spin_once`; thread-safe."""

    def is_connected(self) -> bool:
        """Returns whether all topics of actions are connected."""

    def close(self) -> None:
        """Leaves the graph."""


class Graph:
    """The ROS context, node and executor of the application.

    It is also the clock of the tree: its time is that of the last message on `/clock`.

    The context is rclpy's default one, so that `rclpy.ok()` and `rclpy.create_node()` work in actions; only
    one graph can exist at a time.
    """

    def __init__(self, domain_id: int, on_clock: Callable[[float], None], *, outside: bool = False) -> None:
        self._default = DefaultContext(domain_id, simulated=not outside)
        self._context = self._default.context
        self.domain_id = domain_id
        simulated = not outside or self._has_clock()
        # Robots outside may look for the first few participants alone.
        with contextlib.nullcontext() if outside else ports_of_its_own(domain_id):
            self.node = ActionNode(
                NODE_NAME,
                context=self._context,
                parameter_overrides=[Parameter("use_sim_time", Parameter.Type.BOOL, simulated)],
            )
        self._time_s = 0.0
        self._start_s = time.monotonic()
        self.has_time = False
        self._on_clock = on_clock
        # Ticks have a callback group of their own: an action may spin the node in a tick.
        group = MainThreadGroup()
        if simulated:
            take = self._take_clock
            self.node.create_subscription(Clock, "/clock", take, _CLOCK_QOS, callback_group=group)
        else:
            self.node.create_timer(WALL_PERIOD_S, self._take_wall_time, callback_group=group)
        self._executor = PatientExecutor(context=self._context)
        self._executor.add_node(self.node)
        self._leave: Callable[[], None] = (lambda: None) if outside else await_commands(self.node)

    def now(self) -> float:
        """Returns the simulated time in s."""
        return self._time_s

    def sleep(self, duration_s: float) -> None:
        """Runs callbacks until this much simulated time has passed."""
        end_s = self._time_s + duration_s
        while self._time_s < end_s:
            self.spin_once(0.05)

    def spin_once(self, timeout_s: float) -> None:
        """Runs one callback; waits for one for at most `timeout_s`."""
        try:
            self._executor.spin_once(timeout_sec=timeout_s)
        except ExternalShutdownException:
            return

    def wake(self) -> None:
        """Interrupts a wait of `spin_once`; thread-safe."""
        self._executor.wake()

    def is_connected(self) -> bool:
        """Returns whether all publishers of actions have subscribers, and all subscriptions publishers."""
        said: list[Any] = [s for s in self.node.subscriptions if s.topic_name not in _OWN_TOPICS]
        heard: list[Any] = [p for p in self.node.publishers if p.topic_name not in _OWN_TOPICS]
        return all(self.node.count_publishers(s.topic_name) for s in said) and all(
            p.get_subscription_count() for p in heard
        )

    def close(self) -> None:
        """Leaves the graph."""
        self._leave()
        self._executor.shutdown(timeout_sec=0.2)
        self.node.close()
        self._default.close()

    def _has_clock(self) -> bool:
        """Returns whether an outside graph publishes simulated time on `/clock`."""
        probe = Node(f"{NODE_NAME}_probe", context=self._context)
        end_s = time.monotonic() + CLOCK_PROBE_S
        try:
            while not probe.count_publishers("/clock") and time.monotonic() < end_s:
                time.sleep(0.05)
            return bool(probe.count_publishers("/clock"))
        finally:
            probe.destroy_node()

    def _take_wall_time(self) -> None:
        self._time_s = time.monotonic() - self._start_s
        self.has_time = True
        self._on_clock(self._time_s)

    def _take_clock(self, message: Any) -> None:
        self._time_s = message.clock.sec + message.clock.nanosec * 1e-9
        self.has_time = True
        self._on_clock(self._time_s)
