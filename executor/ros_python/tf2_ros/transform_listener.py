"""`TransformListener`: fills a buffer from `/tf` and `/tf_static`."""

from __future__ import annotations

from threading import Thread
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

__all__ = ["TransformListener"]

DEPTH = 100


class TransformListener:
    """Receives transforms while its node is spun; with `spin_thread`, on a separate thread."""

    def __init__(
        self, buffer: Any, node: Any, *, spin_thread: bool = False, qos: Any = None, static_qos: Any = None
    ) -> None:
        self.buffer, self.node = buffer, node
        self.group = ReentrantCallbackGroup()
        self._spins = spin_thread
        moving = QoSProfile(depth=DEPTH, history=HistoryPolicy.KEEP_LAST) if qos is None else qos
        fixed = static_qos
        if fixed is None:
            durable = DurabilityPolicy.TRANSIENT_LOCAL
            fixed = QoSProfile(depth=DEPTH, history=HistoryPolicy.KEEP_LAST, durability=durable)
        self.tf_sub = node.create_subscription(
            TFMessage, "/tf", self.callback, moving, callback_group=self.group
        )
        self.tf_static_sub = node.create_subscription(
            TFMessage, "/tf_static", self.static_callback, fixed, callback_group=self.group
        )
        getattr(buffer, "_listeners", []).append(self)
        if spin_thread:
            self.executor = SingleThreadedExecutor(context=node.context)
            self.dedicated_listener_thread = Thread(target=self._spin, daemon=True)
            self.dedicated_listener_thread.start()

    def unregister(self) -> None:
        """Ends both subscriptions."""
        listeners = getattr(self.buffer, "_listeners", [])
        if self in listeners:
            listeners.remove(self)
        if self._spins:
            self.executor.shutdown()
            self.dedicated_listener_thread.join()
        self.node.destroy_subscription(self.tf_sub)
        self.node.destroy_subscription(self.tf_static_sub)

    def callback(self, data: Any) -> None:
        """Stores transforms of `/tf`."""
        for transform in data.transforms:
            self.buffer.set_transform(transform, "default_authority")

    def static_callback(self, data: Any) -> None:
        """Stores transforms of `/tf_static`."""
        for transform in data.transforms:
            self.buffer.set_transform_static(transform, "default_authority")

    @property
    def _time_passes(self) -> bool:
        """Whether messages can arrive during a wait. It is False in lock-step, where the world waits too."""
        return not getattr(self.node.executor, "holds_time", False)

    def _take(self) -> None:
        """Reads messages in place of the executor, which is blocked while a callback waits."""
        if self._spins:
            return
        for subscription, take in ((self.tf_static_sub, self.static_callback), (self.tf_sub, self.callback)):
            while (message := _take_one(subscription)) is not None:
                take(message)

    def _spin(self) -> None:
        self.executor.add_node(self.node)
        self.executor.spin()


def _take_one(subscription: Any) -> Any:
    with subscription.handle:
        taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
    return None if taken is None else taken[0]
