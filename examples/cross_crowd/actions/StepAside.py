import math

import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class StepAside(py_trees.behaviour.Behaviour):
    """Drives away from someone near: backwards from those ahead, ahead from those behind."""

    INPUT_PORTS = {
        "bearing": Port(float, required=True, description="Where the person is, in rad; positive is left."),
        "speed": Port(float, default=0.6, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        bearing = get_input(self, "bearing")
        twist = Twist()
        twist.linear.x = -math.copysign(get_input(self, "speed"), math.cos(bearing))
        # Turning puts the person exactly ahead or behind: that is the shortest way out.
        twist.angular.z = 1.5 * math.sin(bearing) * math.copysign(1, math.cos(bearing))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
