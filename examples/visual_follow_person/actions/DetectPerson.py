import cv2
import numpy as np
import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

from tree_gardener.ports import Port, set_output

GREEN_LOW = (45, 90, 40)  # hue in OpenCV's 0-179, saturation and value in 0-255
GREEN_HIGH = (80, 255, 255)
SMALLEST_AREA_PX = 150


class DetectPerson(py_trees.behaviour.Behaviour):
    """Finds the person in green in the camera's picture."""

    NODE_KIND = "Condition"
    OUTPUT_PORTS = {
        "person_pos": Port(float, description="Column of the person's centre in the picture, in pixels."),
        "person_height": Port(float, description="Height of the person as a fraction of the picture's."),
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
        person = self.find_person()
        if person is None:
            return py_trees.common.Status.FAILURE
        x, _, width, height = person
        set_output(self, "person_pos", x + width / 2)
        set_output(self, "person_height", height / self.image.height)
        return py_trees.common.Status.SUCCESS

    def find_person(self):
        """Returns the box (x, y, width, height) in pixels round the largest green patch, or None."""
        if self.image is None:
            return None
        pixels = np.frombuffer(self.image.data, np.uint8).reshape(self.image.height, self.image.width, 3)
        order = cv2.COLOR_RGB2HSV if self.image.encoding == "rgb8" else cv2.COLOR_BGR2HSV
        mask = cv2.inRange(cv2.cvtColor(pixels, order), GREEN_LOW, GREEN_HIGH)
        contours, _ = cv2.findContours(mask, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
        if not contours:
            return None
        largest = max(contours, key=cv2.contourArea)
        return cv2.boundingRect(largest) if cv2.contourArea(largest) >= SMALLEST_AREA_PX else None
