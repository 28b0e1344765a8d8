import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class GoRound(py_trees.behaviour.Behaviour):
    """Drives a circle to the left: round the end of a wall, or until a wall comes in reach."""

    INPUT_PORTS = {
        "speed": Port(float, default=0.25, description="Speed in m/s."),
        "radius": Port(float, default=0.5, description="Radius of the circle in m."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        twist.angular.z = twist.linear.x / get_input(self, "radius")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
