"""Replaces a simulated world by an outside ROS graph, whose robot the application controls.

`OutsideGraph` has the interface of `SimulationLoop`, and handles the same messages. Nothing is simulated; the
time is that of the outside graph. A pause does not stop that time; it only sets the robot's target velocity
to zero.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final, NoReturn

from geometry_msgs.msg import Twist
from rclpy.node import Node

from executor.child_messages import Sim
from executor.world.interface import WorldError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.context import Context

    Send = Callable[[Sim], None]

__all__ = ["NONE", "OutsideGraph"]

NONE: Final = "none"
LOOK_S: Final = 0.02
REPORT_S: Final = 1.0


class _NoStreams:
    """Replaces the streams for a graph without a world."""

    def subscribe(self, client: str | None, stream: str, **wishes: Any) -> None:
        """Does nothing: there are no streams."""

    def unsubscribe(self, client: str | None, stream: str, *, sensor: str) -> None:
        """Does nothing: there are no streams."""

    def pace(self, client: str | None, lost: float) -> None:
        """Does nothing: there are no streams."""


class OutsideGraph:
    """A node in an outside ROS graph, for topic tools, for driving by hand, and to stop the robot."""

    def __init__(self, context: Context, send: Send) -> None:
        self.node = Node("bt_studio", context=context)
        self._velocity = self.node.create_publisher(Twist, "/cmd_vel", 10)
        self._send = send
        self._start_s = time.monotonic()
        self._report_s = 0.0
        self._seen_s = 0.0
        self.is_paused = True
        self.watchers: list[Callable[[float], None]] = []
        self.streams = _NoStreams()

    def pause(self) -> None:
        """Stops the robot; time continues."""
        self.is_paused = True
        self.stop_robots()

    def resume(self) -> None:
        """Allows the application to drive again."""
        self.is_paused = False

    def step(self, dt_s: float) -> None:
        """Does nothing: outside time cannot be stepped."""

    def set_speed(self, speed: float) -> None:
        """Raises an error: the speed of outside time cannot be changed."""
        self._refuse(f"the speed cannot be {speed:g}")

    def reset(self) -> None:
        """Stops the robot; the robot is not moved back."""
        self.stop_robots()

    def teleop(self, linear: float, angular: float, *, goes_on: bool = False) -> None:
        """Drives the robot by hand; `goes_on` has no effect, since outside time always passes."""
        twist = Twist()
        twist.linear.x, twist.angular.z = linear, angular
        self._velocity.publish(twist)

    def stop_robots(self) -> None:
        """Sets the robot's target velocity to zero."""
        self._velocity.publish(Twist())

    def move_body(self, body: str, pose: Sequence[float]) -> None:
        """Raises an error: outside bodies cannot be moved."""
        self._refuse(f"{body!r} cannot be moved to {list(pose)[:2]}")

    def run_due(self, now_s: float) -> None:
        """Runs the topic tools and the other watchers, and sends a `Sim` once a second."""
        self._seen_s = now_s
        for watch in self.watchers:
            watch(now_s)
        if now_s - self._report_s < REPORT_S:
            return
        self._report_s = now_s
        self._send(
            Sim(
                t=now_s - self._start_s,
                real_time_factor=1.0,
                speed=1.0,
                paused=self.is_paused,
                tick_ms=0.0,
                tick_budget_ms=0.0,
                collisions=0,
                distance_m=0.0,
                pose=(0.0, 0.0, 0.0),
            )
        )

    def next_due_s(self, now_s: float) -> float:
        """Returns the seconds until `run_due` has something to do."""
        return max(0.0, self._seen_s + LOOK_S - now_s)

    def close(self) -> None:
        """Stops the robot and leaves the graph."""
        self.stop_robots()
        self.node.destroy_node()

    @staticmethod
    def _refuse(what: str) -> NoReturn:
        raise WorldError(f"{what}: this session runs against an outside graph, which has no simulated world")
