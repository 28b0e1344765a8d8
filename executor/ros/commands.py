"""Commands of a robot on `/cmd_vel`: `Twist`, `TwistStamped`, or both.

A participant of the middleware supports one type for a topic. A robot that accepts both subscribes to `Twist`
with the world's own participant; a second participant for `TwistStamped` is created only when a publisher of
that type appears, since it costs memory and time. If the application is in the world's participant
(lock-step), the robot subscribes to the type that the application publishes.
"""

from __future__ import annotations

import struct
import time
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.serialization import deserialize_message

from executor.ros.raw_take import ignore, take_with_info

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node

    from executor.robots.config import CommandType
    from executor.ros.topic_faults import TopicFaults

TYPES: Final[dict[CommandType, tuple[type, ...]]] = {
    "twist": (Twist,),
    "twist_stamped": (TwistStamped,),
    "both": (Twist, TwistStamped),
}
STAMPED: Final = "geometry_msgs/msg/TwistStamped"
LOOK_S: Final = 0.02
"""Real seconds between two searches for a publisher of the second type, which waits for its subscription."""
AWAIT_S: Final = 1.0
"""The longest real time for which a world waits for a publisher that it has seen."""
REPEAT_S: Final = 0.1
"""So long after its discovery a publisher needs to send again what it had published before."""
_DEPTH: Final = 10
_NS: Final = 1e-9
_LITTLE_ENDIAN: Final = b"\x00\x01\x00\x00"
_TWIST: Final = struct.Struct("<6d")
"""The body of a `Twist`. To read it costs a tenth of making the message, whose fields would be checked."""


class Command(NamedTuple):
    """A target twist in m/s and rad/s, and the simulated time in s from which it is valid."""

    linear: float
    angular: float
    at_s: float


class Commands:
    """The commands of one robot.

    A stamped command is valid for `timeout_s` from its stamp, as with ROS 2's diff_drive_controller; older
    ones are refused. A stamp of 0 or in the future counts as now, since its program may not use simulated
    time. The `frame_id` is ignored: a twist is always in the robot's frame.

    Args:
        node: subscribes to the first type.
        second: returns the node that subscribes to the second type; creates it at the first call.
    """

    def __init__(
        self, node: Node, topic: str, kind: CommandType, timeout_s: float, second: Callable[[], Node]
    ) -> None:
        self.topic = topic
        self.types = TYPES[kind]
        self.notes: list[str] = []
        self.tap: Callable[[str, Any, float], None] | None = None
        self.faults: TopicFaults | None = None
        self._node = node
        self._timeout_s = timeout_s
        self._second = second
        self._subscriptions = {self.types[0]: self._subscribe(node, self.types[0])}
        self._look_at_s = self._await_until_s = 0.0
        self._is_found = True
        self._noted = False

    def take(self, now_s: float) -> tuple[Command | None, bool]:
        """Returns the last command that arrived since the last call (or None), and whether it is valid."""
        if len(self._subscriptions) < len(self.types):
            self._check_for_stamped()
        arrived: list[tuple[int, Any]] = []
        for subscription in self._subscriptions.values():
            while (taken := take_with_info(subscription)) is not None:
                arrived.append((int(taken[1].get("received_timestamp", 0)), taken[0]))
        if self.faults is not None or self.tap is not None:
            arrived = [(at, _as_message(sent)) for at, sent in arrived]
        if self.faults is not None:
            arrived = self._faulty(arrived, self.faults, now_s)
        if not arrived:
            return None, True
        newest = max(arrived, key=lambda each: each[0])[1] if len(self._subscriptions) > 1 else arrived[-1][1]
        if self.tap is not None:
            for _, message in arrived:
                self.tap(self.topic, message, now_s)
        if isinstance(newest, bytes):
            if newest[:4] == _LITTLE_ENDIAN:
                linear, *_, angular = _TWIST.unpack_from(newest, len(_LITTLE_ENDIAN))
                return Command(linear, angular, now_s), True
            newest = _as_message(newest)
        if isinstance(newest, Twist):
            return Command(newest.linear.x, newest.angular.z, now_s), True
        return self._stamped(newest, now_s)

    def awaits_publisher(self, now_s: float) -> bool:
        """Returns whether a publisher of the second type is known, and its first messages may be under way.

        Without a pause they would arrive at a later simulated time. `now_s` is a real time.
        """
        if now_s >= self._await_until_s:
            return False
        if not self._is_found and self._subscriptions[TwistStamped].get_publisher_count():
            self._is_found, self._await_until_s = True, now_s + REPEAT_S
        return True

    def make_way(self, message_type: type) -> None:
        """Changes the type of the subscription in this participant, for a node that uses that type."""
        if message_type in self.types and message_type not in self._subscriptions:
            for subscription in self._subscriptions.values():
                self._node.destroy_subscription(subscription)
            self._subscriptions = {message_type: self._subscribe(self._node, message_type)}

    def _faulty(
        self, arrived: list[tuple[int, Any]], faults: TopicFaults, now_s: float
    ) -> list[tuple[int, Any]]:
        """Returns the commands that faults let through, and those that they have delayed until now."""
        passed = [(at, sent) for at, message in arrived for sent in faults.take(self.topic, message, now_s)]
        late = [(0, message) for _, message in faults.due(now_s, {self.topic})]
        return [*late, *passed]

    def _subscribe(self, node: Node, message_type: type) -> Any:
        return node.create_subscription(message_type, self.topic, ignore, _DEPTH, raw=message_type is Twist)

    def _check_for_stamped(self) -> None:
        now_s = time.monotonic()
        if now_s < self._look_at_s or Twist not in self._subscriptions:
            return
        self._look_at_s = now_s + LOOK_S
        published = {end.topic_type for end in self._node.get_publishers_info_by_topic(self.topic)}
        if STAMPED in published:
            self._subscriptions[TwistStamped] = self._subscribe(self._second(), TwistStamped)
            self._is_found, self._await_until_s = False, time.monotonic() + AWAIT_S

    def _stamped(self, message: Any, now_s: float) -> tuple[Command | None, bool]:
        stamp, twist = message.header.stamp, message.twist
        stamp_s = stamp.sec + stamp.nanosec * _NS
        at_s = now_s if stamp_s == 0 else min(stamp_s, now_s)
        if now_s - at_s > self._timeout_s:
            if not self._noted:
                self._noted = True
                self.notes.append(
                    f"{self.topic}: a command is left out since its stamp ({stamp_s:.2f} s) is "
                    f"{now_s - at_s:.2f} s old; the drive holds commands for {self._timeout_s:g} s. Stamp it "
                    "with the node's clock (use_sim_time), or with 0."
                )
            return None, False
        return Command(twist.linear.x, twist.angular.z, at_s), True


def _as_message(sent: Any) -> Any:
    return deserialize_message(sent, Twist) if isinstance(sent, bytes) else sent
