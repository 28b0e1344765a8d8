"""Subscriptions that take messages raw, of publishers with any quality of service."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from executor.ros.raw_take import ignore

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = ["LARGE_TYPES", "subscribe_raw"]

DEPTH: Final = 50
LARGE_TYPES: Final = frozenset({"sensor_msgs/msg/Image", "sensor_msgs/msg/PointCloud2"})
"""Types to which nobody subscribes unasked: that would start the renderer, or cost more than all else."""
_QOS: Final = QoSProfile(
    depth=DEPTH, reliability=ReliabilityPolicy.BEST_EFFORT, durability=DurabilityPolicy.VOLATILE
)
_LATCHED_QOS: Final = QoSProfile(
    depth=DEPTH, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL
)


def subscribe_raw(node: Node, topic: str, kind: type) -> Any:
    """Subscribes to a topic as each of its publishers can serve it.

    Latched publishers also give their last messages. Read the messages by `raw_take.take`.
    """
    publishers = node.get_publishers_info_by_topic(topic)
    is_latched = bool(publishers) and all(
        end.qos_profile.durability is DurabilityPolicy.TRANSIENT_LOCAL for end in publishers
    )
    return node.create_subscription(kind, topic, ignore, _LATCHED_QOS if is_latched else _QOS, raw=True)
