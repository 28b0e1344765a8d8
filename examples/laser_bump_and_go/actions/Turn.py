import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class Turn(py_trees.behaviour.Behaviour):
    """Turns on the spot."""

    INPUT_PORTS = {
        "ang_speed": Port(float, default=0.6, description="Turning speed in rad/s; positive turns left.")
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def initialise(self):
        print("Turning")

    def update(self):
        twist = Twist()
        twist.angular.z = get_input(self, "ang_speed")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
