import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class SteerAlong(py_trees.behaviour.Behaviour):
    """Drives on and turns towards the line, the more the farther it is from the middle."""

    INPUT_PORTS = {
        "offset": Port(float, required=True, description="Where the line is, from -1 to 1."),
        "speed": Port(float, default=0.35, description="Speed in m/s on straight stretches."),
        "gain": Port(float, default=0.9, description="Curvature of the way for an offset of 1, in 1/m."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        offset = get_input(self, "offset")
        twist = Twist()
        # Bends are driven more slowly: there the line leaves the picture first.
        twist.linear.x = get_input(self, "speed") * max(0.3, 1 - abs(offset))
        # Turning goes with the speed, so that the way is the same circle, however fast it is driven.
        twist.angular.z = -get_input(self, "gain") * offset * twist.linear.x
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
