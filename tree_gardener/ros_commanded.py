"""The topics on which a node has commanded motion, so that the end of a run can stop what it moved."""

import threading
import time
import weakref
from collections.abc import Callable
from typing import Any, Final

import tree_gardener.ros_wheels  # noqa: F401 - refuses two ROS before rclpy is loaded

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.duration import Duration

VELOCITIES: Final = (Twist, TwistStamped)
PERIOD_S: Final = 0.02
DISCOVERY_S: Final = 0.5
ARRIVAL_S: Final = 0.2
LOOK_S: Final = 0.05
NANOSECONDS: Final = 1_000_000_000


class Commanded:
    """Publishes zero velocities, but only where this process itself has published others in this run.

    Args:
        node: the node whose publishers are watched.
        sleep: waits for a time in s between two messages.
    """

    def __init__(self, node: Any, sleep: Callable[[float], None] = time.sleep) -> None:
        self._node: Callable[[], Any] = weakref.ref(node)
        self._sleep = sleep
        self._moved: dict[tuple[str, type], _Moved] = {}

    def watch(self, publisher: Any) -> None:
        """Notes when velocities that are not zero are published; other messages are no commands."""
        if publisher.msg_type not in VELOCITIES:
            return
        publish, key = publisher.publish, (publisher.topic_name, publisher.msg_type)

        def publish_noted(message: Any) -> None:
            publish(message)
            is_zero = _is_zero(message)
            moved = self._moved.get(key)
            if moved is None or moved.publisher is not publisher:
                if is_zero:
                    return
                moved = self._moved[key] = _Moved(publisher, message)
            moved.rests, moved.at_s = is_zero, self._now_s()

        publisher.publish = publish_noted

    def begin(self) -> None:
        """Begins a run, in which nothing has moved yet."""
        self._moved.clear()

    def end(self) -> None:
        """Ends a run: its publishers may close once the last commands have arrived, or after a short time."""
        publishers = list(self._node().publishers)
        for moved in self._moved.values():
            if any(publisher is moved.publisher for publisher in publishers):
                moved.publisher.wait_for_all_acked(Duration(seconds=ARRIVAL_S))
        self.begin()

    def stop(self, times: int = 1) -> None:
        """Publishes zero velocities, so many times."""
        senders = [moved.sender(self._node()) for moved in list(self._moved.values())]
        for number in range(times if senders else 0):
            if number:
                self._sleep(PERIOD_S)
            for send in senders:
                send()

    def expire(self, timeout_s: float) -> None:
        """Publishes zero once where the last command is a motion and older than this time; logs it."""
        now_s = self._now_s()
        for moved in list(self._moved.values()):
            if not moved.rests and now_s - moved.at_s > timeout_s:
                moved.rests = True
                node = self._node()
                moved.sender(node)()
                node.get_logger().warning(
                    f"no command on {moved.topic} for {timeout_s:g} s while the tree runs: it was stopped"
                    " (cmd_timeout_s)"
                )

    def watched(self, timeout_s: float) -> Callable[[], None]:
        """Calls `expire` now and then on a thread, also while a tick hangs; returns what ends it.

        A timeout of 0 watches nothing.
        """
        is_over = threading.Event()

        def look() -> None:
            while not is_over.wait(LOOK_S):
                self.expire(timeout_s)

        thread = threading.Thread(target=look, name="commanded", daemon=True)
        if timeout_s > 0:
            thread.start()

        def end() -> None:
            is_over.set()
            if thread.ident is not None:
                thread.join()

        return end

    def _now_s(self) -> float:
        return float(self._node().get_clock().now().nanoseconds) / NANOSECONDS


class _Moved:
    """A topic with a command that was not zero.

    Attributes:
        publisher: the publisher that has sent it.
        topic: the name of the topic.
        rests: whether the last command was zero.
        at_s: the node's time of the last command.
    """

    def __init__(self, publisher: Any, message: Any) -> None:
        self.publisher = publisher
        self.topic: str = publisher.topic_name
        self.rests = False
        self.at_s = 0.0
        self._type, self._qos = publisher.msg_type, publisher.qos_profile
        self._frame = message.header.frame_id if isinstance(message, TwistStamped) else ""

    def sender(self, node: Any) -> Callable[[], None]:
        """Returns a function that publishes zero; an action may have destroyed its publisher."""
        if not any(publisher is self.publisher for publisher in node.publishers):
            self.publisher = node.create_publisher(self._type, self.topic, self._qos)
            end_s = time.monotonic() + DISCOVERY_S
            while not self.publisher.get_subscription_count() and time.monotonic() < end_s:
                time.sleep(PERIOD_S)
        return lambda: self.publisher.publish(self._zero(node))

    def _zero(self, node: Any) -> Any:
        message = self._type()
        if isinstance(message, TwistStamped):
            message.header.stamp = node.get_clock().now().to_msg()
            message.header.frame_id = self._frame
        return message


def _is_zero(message: Any) -> bool:
    """Returns whether a message commands no motion; bytes are taken for a motion."""
    twist = getattr(message, "twist", message)
    if isinstance(twist, bytes):
        return False
    parts = twist.linear, twist.angular
    return not any(value for part in parts for value in (part.x, part.y, part.z))
