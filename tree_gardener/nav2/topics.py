"""Topics that Nav2's nodes subscribe to. Classes of messages are imported when they are needed.

A tree that runs without ROS has no topics: nothing is ever received.
"""

import importlib
import math
from collections import deque
from collections.abc import Callable
from typing import Any, Final

DEPTH: Final = 10


def message_class(package: str, name: str) -> Any:
    """Returns the class of a message."""
    return getattr(importlib.import_module(f"{package}.msg"), name)


def service_class(package: str, name: str) -> Any:
    """Returns the class of a service."""
    return getattr(importlib.import_module(f"{package}.srv"), name)


def parameter(ros_node: Any, name: str, default: Any) -> Any:
    """Returns a parameter of the ROS node, if it is declared there."""
    if ros_node is None or not ros_node.has_parameter(name):
        return default
    return ros_node.get_parameter(name).value


class Topic:
    """The latest message of a topic.

    Args:
        ros_node: The ROS node, or None.
        package: The package of the message.
        name: The name of the message type.
        latched: Whether messages from before the subscription are wanted.
    """

    def __init__(self, ros_node: Any, package: str, name: str, *, latched: bool = False) -> None:
        self._node = ros_node
        self._type = (package, name)
        self._latched = latched
        self._subscription: Any = None
        self.topic = ""
        self.message: Any = None

    def follow(self, topic: str, received: Callable[[Any], None] | None = None) -> None:
        """Subscribes to a topic, unless it is already subscribed to this topic."""
        if self._node is None or topic == self.topic or not topic:
            return
        self.close()
        self.topic = topic
        qos: Any = DEPTH
        if self._latched:
            from rclpy.qos import DurabilityPolicy, QoSProfile  # noqa: PLC0415 - only where ROS is

            qos = QoSProfile(depth=DEPTH, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        kind = message_class(*self._type)
        self._subscription = self._node.create_subscription(kind, topic, received or self._received, qos)

    def take(self) -> Any:
        """Returns the latest message that was not returned before, or None."""
        message, self.message = self.message, None
        return message

    def close(self) -> None:
        """Ends the subscription."""
        if self._subscription is not None:
            self._node.destroy_subscription(self._subscription)
            self._subscription = None

    def _received(self, message: Any) -> None:
        self.message = message


class Odometer:
    """The robot's velocity, latest and smoothed over 0.3 s, as ``nav2_util/odometry_utils``.

    The ROS node's parameters `odom_topic` (default `odom`) and `filter_duration` set the topic and the time.
    """

    def __init__(self, ros_node: Any) -> None:
        self._history: deque[Any] = deque()
        self._duration_s = float(parameter(ros_node, "filter_duration", 0.3))
        self._topic = Topic(ros_node, "nav_msgs", "Odometry")
        self._topic.follow(parameter(ros_node, "odom_topic", "odom"), self.received)

    def received(self, odometry: Any) -> None:
        """Adds a message and removes those that are too old."""
        self._history.append(odometry)
        time_s = stamp_s(odometry.header.stamp)
        while time_s - stamp_s(self._history[0].header.stamp) > self._duration_s:
            self._history.popleft()

    @property
    def latest(self) -> Any:
        """The latest message, or None."""
        return self._history[-1] if self._history else None

    def speed(self) -> float:
        """Returns the smoothed speed in the plane; 0 before the first message."""
        count = len(self._history)
        if not count:
            return 0.0
        x = sum(odometry.twist.twist.linear.x for odometry in self._history) / count
        y = sum(odometry.twist.twist.linear.y for odometry in self._history) / count
        return math.hypot(x, y)

    def close(self) -> None:
        """Ends the subscription."""
        self._topic.close()


def stamp_s(stamp: Any) -> float:
    """Returns a stamp in seconds."""
    return float(stamp.sec) + float(stamp.nanosec) * 1e-9
