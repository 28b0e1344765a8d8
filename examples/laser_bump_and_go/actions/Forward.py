import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class Forward(py_trees.behaviour.Behaviour):
    """Drives straight ahead."""

    INPUT_PORTS = {"lin_speed": Port(float, default=0.3, description="Speed ahead in m/s.")}

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def initialise(self):
        print("The way is free: driving ahead")

    def update(self):
        twist = Twist()
        twist.linear.x = get_input(self, "lin_speed")
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
