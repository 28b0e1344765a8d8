import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class SteerTowards(py_trees.behaviour.Behaviour):
    """Drives towards an object at an offset in the picture, until it is ahead and large enough."""

    INPUT_PORTS = {
        "offset": Port(float, required=True, description="Where it is: -1 at the left edge, 1 at the right."),
        "height": Port(float, required=True, description="Its height as a part of the picture's."),
        "near": Port(float, default=0.6, description="At which height it is near enough."),
        "speed": Port(float, default=0.35, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        offset, height, near = (get_input(self, name) for name in ("offset", "height", "near"))
        if height >= near and abs(offset) < 0.15:
            return py_trees.common.Status.SUCCESS
        twist = Twist()
        twist.angular.z = -1.2 * offset
        if abs(offset) < 0.5 and height < near:
            twist.linear.x = max(0.08, get_input(self, "speed") * min(1.0, 3 * (1 - height / near)))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
