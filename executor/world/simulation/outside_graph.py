"""No world of ours: a session in which the application drives what an outside ROS graph has.

It has the face of `SimulationLoop`, for the same messages. Nothing is simulated, time is the outside's own,
and a pause cannot stop it: what it can do is to tell the robot to stand.
"""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any, Final, NoReturn

from geometry_msgs.msg import Twist
from rclpy.node import Node

from executor.world.interface import WorldError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.context import Context

    Send = Callable[[dict[str, Any]], None]

__all__ = ["NONE", "OutsideGraph"]

NONE: Final = "none"
LOOK_S: Final = 0.02
REPORT_S: Final = 1.0


class _NoStreams:
    """There is nothing to see."""

    def subscribe(self, client: str | None, stream: str, **wishes: Any) -> None:
        """Sends nothing."""

    def unsubscribe(self, client: str | None, stream: str) -> None:
        """Ends nothing."""

    def pace(self, client: str | None, lost: float) -> None:
        """Slows nothing."""


class OutsideGraph:
    """A node in an outside graph, through which a session looks at it and stops its robot."""

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
        """Has the robot stand; time goes on."""
        self.is_paused = True
        self.stop_robots()

    def resume(self) -> None:
        """Lets the application drive again."""
        self.is_paused = False

    def step(self, dt_s: float) -> None:
        """Does nothing: the outside's time cannot be stepped."""

    def set_speed(self, speed: float) -> None:
        """Refuses."""
        self._refuse(f"the speed cannot be {speed:g}")

    def reset(self) -> None:
        """Has the robot stand; it stays where it is."""
        self.stop_robots()

    def teleop(self, linear: float, angular: float, *, goes_on: bool = False) -> None:
        """Drives the robot by hand; the outside's time goes on anyway."""
        twist = Twist()
        twist.linear.x, twist.angular.z = linear, angular
        self._velocity.publish(twist)

    def stop_robots(self) -> None:
        """Tells the robot to stand."""
        self._velocity.publish(Twist())

    def move_body(self, body: str, pose: Sequence[float]) -> None:
        """Refuses."""
        self._refuse(f"{body!r} cannot be moved to {list(pose)[:2]}")

    def run_due(self, now_s: float) -> None:
        """Looks at the graph, and says once a second that it is there."""
        self._seen_s = now_s
        for watch in self.watchers:
            watch(now_s)
        if now_s - self._report_s < REPORT_S:
            return
        self._report_s = now_s
        self._send(
            {
                "type": "sim",
                "t": now_s - self._start_s,
                "real_time_factor": 1.0,
                "speed": 1.0,
                "paused": self.is_paused,
                "tick_ms": 0.0,
                "tick_budget_ms": 0.0,
                "collisions": 0,
                "distance_m": 0.0,
                "pose": (0.0, 0.0, 0.0),
            }
        )

    def next_due_s(self, now_s: float) -> float:
        """Returns the seconds until `run_due` has something to do."""
        return max(0.0, self._seen_s + LOOK_S - now_s)

    def close(self) -> None:
        """Has the robot stand, and leaves the graph."""
        self.stop_robots()
        self.node.destroy_node()

    @staticmethod
    def _refuse(what: str) -> NoReturn:
        raise WorldError(f"{what}: this session runs against an outside graph, which has no simulated world")
