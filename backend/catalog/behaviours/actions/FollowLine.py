import numpy as np
import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

from tree_gardener.ports import Port, get_input


class FollowLine(py_trees.behaviour.Behaviour):
    """Follows a dark line on a light floor with the camera; it fails when the line is lost for a second."""

    INPUT_PORTS = {
        "speed": Port(float, default=0.25, description="Speed in m/s on straight stretches."),
        "darkness": Port(int, default=80, description="How bright the line is at most, from 0 to 255."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.image = None
        self.offset = 0.0
        self.lost = 0
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.subscription = node.create_subscription(
            Image, "/camera/image_raw", self.on_image, qos_profile_sensor_data
        )

    def on_image(self, image: Image):
        self.image = image

    def initialise(self):
        self.lost = 0

    def line_offset(self):
        """Returns the position of the line in the lower part of the picture, from -1 to 1, or None."""
        image = self.image
        pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
        pixels = pixels[:, : image.width * 3].reshape(image.height, image.width, 3)
        floor = pixels[int(0.75 * image.height) :: 3, ::3].max(axis=2)
        columns = np.nonzero(floor <= get_input(self, "darkness"))[1]
        return float(2 * columns.mean() / floor.shape[1] - 1) if len(columns) > 20 else None

    def update(self):
        if self.image is None:
            return py_trees.common.Status.RUNNING
        offset = self.line_offset()
        self.lost = 0 if offset is not None else self.lost + 1
        if self.lost > 20:
            return py_trees.common.Status.FAILURE
        # A line out of sight is assumed a little farther than where it was seen last.
        self.offset = offset if offset is not None else max(-1.0, min(1.0, 1.5 * self.offset))
        twist = Twist()
        twist.angular.z = -1.6 * self.offset
        twist.linear.x = get_input(self, "speed") * max(0.2, 1 - abs(self.offset))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
