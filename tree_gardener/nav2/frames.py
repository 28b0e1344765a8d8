"""Computes the pose of the robot by tf. All nodes of one ROS node share a buffer of transforms.

Nav2 waits for a transform up to `transform_tolerance`; here a tick does not wait, since messages arrive only
between ticks: a pose that is not known yet may be known at a later tick.
"""

from typing import Any, Final

from tree_gardener.nav2.reading import input_or
from tree_gardener.nav2.topics import message_class, parameter

FRAMES: Final = {"global_frame": "map", "robot_base_frame": "base_link"}


class Frames:
    """Transforms for one node of a tree; without ROS there are none.

    Args:
        node: The node of the tree.
        ros_node: The ROS node, or None.
    """

    def __init__(self, node: Any, ros_node: Any) -> None:
        self._node = node
        self._ros_node = ros_node
        self._buffer = None if ros_node is None else _buffer_of(ros_node)

    def frame(self, port: str) -> str:
        """Returns a frame: the port, the ROS node's parameter of that name, or Nav2's default."""
        return str(input_or(self._node, port, "") or parameter(self._ros_node, port, FRAMES[port]))

    def can_transform(self, target: str, source: str) -> bool:
        """Returns whether a transform between two frames is known."""
        if self._buffer is None:
            return False
        from rclpy.time import Time  # noqa: PLC0415 - only where ROS is

        return bool(self._buffer.can_transform(target, source, Time()))

    def robot_pose(self, frame: str = "", base: str = "") -> Any:
        """Returns the robot's pose in a frame as a PoseStamped; None if it is not known."""
        frame, base = frame or self.frame("global_frame"), base or self.frame("robot_base_frame")
        if self._buffer is None:
            return None
        from rclpy.time import Time  # noqa: PLC0415 - only where ROS is
        from tf2_ros import TransformException  # noqa: PLC0415 - as above

        try:
            found = self._buffer.lookup_transform(frame, base, Time())
        except TransformException:
            return None
        pose = message_class("geometry_msgs", "PoseStamped")(header=found.header)
        place = found.transform.translation
        pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = place.x, place.y, place.z
        pose.pose.orientation = found.transform.rotation
        return pose

    def transformed(self, pose: Any, frame: str) -> Any:
        """Returns a stamped pose in another frame; None if the transform is not known."""
        if pose.header.frame_id == frame:
            return pose
        if self._buffer is None:
            return None
        import tf2_geometry_msgs  # noqa: F401, PLC0415 - it teaches the buffer poses
        from tf2_ros import TransformException  # noqa: PLC0415 - only where ROS is

        try:
            return self._buffer.transform(pose, frame)
        except TransformException:
            return None


def _buffer_of(ros_node: Any) -> Any:
    """Returns the buffer of a ROS node; creates it at the first request."""
    buffer = getattr(ros_node, "nav2_buffer", None)
    if buffer is None:
        from tf2_ros import Buffer, TransformListener  # noqa: PLC0415 - only where ROS is

        # On the ROS node, so that they live as long as it does.
        buffer = ros_node.nav2_buffer = Buffer(node=ros_node)
        ros_node.nav2_listener = TransformListener(buffer, ros_node)
    return buffer
