import py_trees
from geometry_msgs.msg import Twist
from rclpy.duration import Duration
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class NewAction(py_trees.behaviour.Behaviour):
    """Drives for some seconds, then stops."""

    INPUT_PORTS = {
        "seconds": Port(float, default=2.0, description="How long it drives, in s."),
        "speed": Port(float, default=0.2, description="Speed ahead in m/s; negative: back."),
        "turn": Port(float, default=0.0, description="Speed of the turn in rad/s; positive: to the left."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.clock = node.get_clock()
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def initialise(self):
        self.end = self.clock.now() + Duration(seconds=get_input(self, "seconds"))

    def update(self):
        if self.clock.now() >= self.end:
            return py_trees.common.Status.SUCCESS
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        twist.angular.z = get_input(self, "turn")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        # At the end, and when the block is halted before.
        self.publisher.publish(Twist())
