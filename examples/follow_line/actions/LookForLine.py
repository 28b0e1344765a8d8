import math

import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class LookForLine(py_trees.behaviour.Behaviour):
    """Turns on the spot, to the side where the line was seen last."""

    INPUT_PORTS = {
        "offset": Port(float, default="{offset}", description="Where the line was last, from -1 to 1."),
        "ang_speed": Port(float, default=0.6, description="Turning speed in rad/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def initialise(self):
        # The side is chosen once: while the robot turns, nothing new is known.
        self.side = -math.copysign(1, get_input(self, "offset"))

    def update(self):
        twist = Twist()
        twist.angular.z = self.side * get_input(self, "ang_speed")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
