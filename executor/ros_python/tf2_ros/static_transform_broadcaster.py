"""`StaticTransformBroadcaster`: publishes constant transforms on `/tf_static`."""

from __future__ import annotations

from typing import Any

from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_msgs.msg import TFMessage
from tf2_ros.transform_broadcaster import listed

__all__ = ["StaticTransformBroadcaster"]


class StaticTransformBroadcaster:
    """Publishes constant transforms; subscribers that join later receive all of them too."""

    def __init__(self, node: Any, qos: Any = None) -> None:
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.pub_tf = node.create_publisher(TFMessage, "/tf_static", latched if qos is None else qos)
        self._sent: dict[str, Any] = {}

    def sendTransform(self, transform: Any) -> None:  # noqa: N802 - its name in tf2
        """Publishes a `TransformStamped`, or a list of them, together with all that were sent before."""
        self._sent |= {each.child_frame_id: each for each in listed(transform)}
        self.pub_tf.publish(TFMessage(transforms=list(self._sent.values())))
