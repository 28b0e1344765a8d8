import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input

TURN_GAIN = 1.2  # rad/s when the person is at the picture's edge
DISTANCE_GAIN = 4.0  # m/s for a person that looks too small by the picture's whole height
WANTED_HEIGHT = 0.72  # a person this tall in the picture is about 2 m away
FASTEST = 0.7  # m/s


class Move(py_trees.behaviour.Behaviour):
    """Turns towards the person and keeps the distance."""

    INPUT_PORTS = {
        "person_pos": Port(float, required=True, description="Column of the person's centre, in pixels."),
        "person_height": Port(
            float, default="{person_height}", description="Height as a fraction of the picture's."
        ),
        "image_x_center": Port(
            float, default=320.0, description="Column of the picture's centre, in pixels."
        ),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def initialise(self):
        print("Person in sight: following")

    def update(self):
        center = get_input(self, "image_x_center")
        off_center = (center - get_input(self, "person_pos")) / center
        too_small = WANTED_HEIGHT - get_input(self, "person_height")
        twist = Twist()
        twist.angular.z = TURN_GAIN * off_center
        twist.linear.x = max(-FASTEST, min(FASTEST, DISTANCE_GAIN * too_small))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
