import math

import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class GoRound(py_trees.behaviour.Behaviour):
    """Drives on and turns away from someone ahead."""

    INPUT_PORTS = {
        "bearing": Port(float, required=True, description="Where the person is, in rad; positive is left."),
        "speed": Port(float, default=0.35, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        # Someone on the left is passed on the right, and the other way round.
        twist.angular.z = -math.copysign(0.9, get_input(self, "bearing"))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
