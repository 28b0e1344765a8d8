import numpy as np
import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

from tree_gardener.ports import Port, get_input, set_output


class SeesLine(py_trees.behaviour.Behaviour):
    """Succeeds if the camera sees a dark line on the floor, and tells where."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "darkness": Port(int, default=80, description="How bright the line is at most, from 0 to 255.")
    }
    OUTPUT_PORTS = {
        "offset": Port(float, description="Where the line is: -1 at the left edge, 1 at the right.")
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.image = None
        self.subscription = node.create_subscription(
            Image, "/camera/image_raw", self.on_image, qos_profile_sensor_data
        )

    def on_image(self, image: Image):
        self.image = image

    def update(self):
        if self.image is None:
            return py_trees.common.Status.FAILURE
        height, width = self.image.height, self.image.width
        pixels = np.frombuffer(self.image.data, np.uint8).reshape(height, width, 3)
        # The lowest strip shows the floor just ahead of the robot; every third pixel is enough.
        floor = pixels[int(0.85 * height) :: 3, ::3].max(axis=2)
        columns = np.nonzero(floor <= get_input(self, "darkness"))[1]
        if len(columns) < 20:
            return py_trees.common.Status.FAILURE
        set_output(self, "offset", float(2 * columns.mean() / floor.shape[1] - 1))
        return py_trees.common.Status.SUCCESS
