import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class LookAround(py_trees.behaviour.Behaviour):
    """Turns on the spot until it is halted; it fails after a time."""

    INPUT_PORTS = {
        "speed": Port(float, default=0.6, description="Turning speed in rad/s; positive turns left."),
        "timeout": Port(float, default=20.0, description="After how long it gives up, in s."),
    }

    def setup(self, **kwargs):
        self.node: Node = kwargs["node"]
        self.began_s = 0.0
        self.publisher = self.node.create_publisher(Twist, "/cmd_vel", 10)

    def now_s(self):
        return self.node.get_clock().now().nanoseconds / 1e9

    def initialise(self):
        self.began_s = self.now_s()

    def update(self):
        if self.now_s() - self.began_s > get_input(self, "timeout"):
            return py_trees.common.Status.FAILURE
        twist = Twist()
        twist.angular.z = get_input(self, "speed")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
