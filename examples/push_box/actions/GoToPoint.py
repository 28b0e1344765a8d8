import math

import py_trees
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class GoToPoint(py_trees.behaviour.Behaviour):
    """Drives to a point by odometry, in a straight line: it looks for no obstacles."""

    INPUT_PORTS = {
        "x": Port(float, default=1.0, description="The point, in m, in the frame of the odometry."),
        "y": Port(float, default=0.0, description="The point, in m, in the frame of the odometry."),
        "speed": Port(float, default=0.4, description="Speed in m/s."),
        "tolerance": Port(float, default=0.05, description="How near is there, in m."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.pose = None
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.subscription = node.create_subscription(Odometry, "/odom", self.on_odometry, 10)

    def on_odometry(self, odometry: Odometry):
        position, q = odometry.pose.pose.position, odometry.pose.pose.orientation
        heading = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        self.pose = (position.x, position.y, heading)

    def update(self):
        if self.pose is None:
            return py_trees.common.Status.RUNNING
        x, y, heading = self.pose
        dx, dy = get_input(self, "x") - x, get_input(self, "y") - y
        distance = math.hypot(dx, dy)
        if distance <= get_input(self, "tolerance"):
            return py_trees.common.Status.SUCCESS
        off = math.remainder(math.atan2(dy, dx) - heading, math.tau)
        twist = Twist()
        twist.angular.z = max(-1.2, min(1.2, 2.5 * off))
        if abs(off) < 0.6:
            twist.linear.x = min(get_input(self, "speed"), max(0.05, distance)) * math.cos(off)
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
