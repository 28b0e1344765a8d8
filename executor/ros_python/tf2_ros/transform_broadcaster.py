"""`TransformBroadcaster`: publishes transforms on `/tf`."""

from __future__ import annotations

from typing import Any

from rclpy.qos import QoSProfile
from tf2_msgs.msg import TFMessage

__all__ = ["TransformBroadcaster"]


class TransformBroadcaster:
    """Publishes transforms that change."""

    def __init__(self, node: Any, qos: Any = None) -> None:
        self.pub_tf = node.create_publisher(TFMessage, "/tf", QoSProfile(depth=100) if qos is None else qos)

    def sendTransform(self, transform: Any) -> None:  # noqa: N802 - its name in tf2
        """Publishes a `TransformStamped`, or a list of them."""
        self.pub_tf.publish(TFMessage(transforms=listed(transform)))


def listed(transform: Any) -> list[Any]:
    """Returns a list: of one transform, or of several."""
    return list(transform) if hasattr(transform, "__iter__") else [transform]
