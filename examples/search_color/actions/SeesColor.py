import numpy as np
import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Image

from tree_gardener.ports import Port, get_input, set_output


class SeesColor(py_trees.behaviour.Behaviour):
    """Succeeds if the camera sees a patch of a colour, and outputs its position."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "color": Port(str, default="#20c020", description="The colour, as #rrggbb."),
        "share": Port(float, default=0.001, description="How much of the picture it must fill, from 0 to 1."),
    }
    OUTPUT_PORTS = {
        "offset": Port(
            float, default="{=}", description="Where its middle is: -1 at the left edge, 1 at the right."
        ),
        "height": Port(
            float, default="{=}", description="Its height as a part of the picture's, from 0 to 1."
        ),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.image = None
        self.subscription = node.create_subscription(
            Image, "/camera/image_raw", self.on_image, qos_profile_sensor_data
        )

    def on_image(self, image: Image):
        self.image = image

    def mask(self):
        """Returns the pixels with the colour, whatever the light; it tests every second one."""
        image = self.image
        pixels = np.frombuffer(image.data, np.uint8).reshape(image.height, image.step)
        pixels = (
            pixels[:, : image.width * 3].reshape(image.height, image.width, 3)[::2, ::2].astype(np.float32)
        )
        code = get_input(self, "color").lstrip("#")
        wanted = np.array([int(code[at : at + 2], 16) for at in (0, 2, 4)], np.float32)
        if image.encoding == "bgr8":
            wanted = wanted[::-1]
        # Shadow and light change how bright a colour is, not how its parts compare.
        lengths = np.linalg.norm(pixels, axis=2) * np.linalg.norm(wanted)
        return (pixels @ wanted > 0.97 * lengths) & (pixels.max(axis=2) > 30)

    def update(self):
        if self.image is None:
            return py_trees.common.Status.FAILURE
        mask = self.mask()
        if mask.mean() < get_input(self, "share"):
            return py_trees.common.Status.FAILURE
        rows, columns = np.nonzero(mask)
        set_output(self, "offset", float(2 * np.median(columns) / mask.shape[1] - 1))
        low, high = np.percentile(rows, [2, 98])
        set_output(self, "height", float((high - low) / mask.shape[0]))
        return py_trees.common.Status.SUCCESS
