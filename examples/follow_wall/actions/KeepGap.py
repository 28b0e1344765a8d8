import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class KeepGap(py_trees.behaviour.Behaviour):
    """Drives ahead and steers so that the gap to the wall on the left stays the same."""

    INPUT_PORTS = {
        "gap": Port(float, required=True, description="How far the wall is, in m."),
        "wanted": Port(float, default=0.5, description="How far it should be, in m."),
        "speed": Port(float, default=0.3, description="Speed ahead in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)

    def update(self):
        too_far = get_input(self, "gap") - get_input(self, "wanted")
        twist = Twist()
        twist.linear.x = get_input(self, "speed")
        # Too far from the wall turns left, towards it; too near turns right. The limit keeps it calm.
        twist.angular.z = max(-0.7, min(0.7, 1.8 * too_far))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
