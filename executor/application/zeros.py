"""Stops a robot of an outside graph while the debugger holds the tree: zero on its command topics."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

from geometry_msgs.msg import Twist, TwistStamped

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

__all__ = ["PERIOD_S", "Zeros"]

PERIOD_S: Final = 0.1
VELOCITIES: Final = (Twist, TwistStamped)


class Zeros:
    """Publishes zero velocities with the publishers that the actions of this run have made.

    Args:
        node: the node of the actions.
        clock: limits the rate, in s.
    """

    def __init__(self, node: Node, clock: Callable[[], float] = time.monotonic) -> None:
        self._node = node
        self._clock = clock
        self._due_s = 0.0

    def send(self) -> None:
        """Publishes zeros, at most ten times a second."""
        now_s = self._clock()
        if now_s < self._due_s:
            return
        self._due_s = now_s + PERIOD_S
        for publisher in self._node.publishers:
            if publisher.msg_type in VELOCITIES:
                message = publisher.msg_type()
                if isinstance(message, TwistStamped):
                    message.header.stamp = self._node.get_clock().now().to_msg()
                publisher.publish(message)
