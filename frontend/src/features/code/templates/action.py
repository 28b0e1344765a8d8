import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class NewAction(py_trees.behaviour.Behaviour):
    """Describes the action in one line."""

    INPUT_PORTS = {"speed": Port(float, default=0.2, description="Speed ahead in m/s.")}

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def initialise(self):
        print("NewAction begins")

    def update(self):
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
