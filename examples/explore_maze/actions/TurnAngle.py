import math

import py_trees
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class TurnAngle(py_trees.behaviour.Behaviour):
    """Turns on the spot by an angle, also by more than a full turn."""

    INPUT_PORTS = {
        "angle": Port(float, default=90.0, description="How far, in degrees; positive turns left."),
        "speed": Port(float, default=0.8, description="Turning speed in rad/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.heading = None
        self.before = None
        self.turned = 0.0
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.subscription = node.create_subscription(Odometry, "/odom", self.on_odometry, 10)

    def on_odometry(self, odometry: Odometry):
        q = odometry.pose.pose.orientation
        self.heading = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))

    def initialise(self):
        self.before = None
        self.turned = 0.0

    def update(self):
        if self.heading is None:
            return py_trees.common.Status.RUNNING
        if self.before is not None:
            self.turned += math.remainder(self.heading - self.before, math.tau)
        self.before = self.heading
        left = math.radians(get_input(self, "angle")) - self.turned
        if abs(left) <= math.radians(1):
            return py_trees.common.Status.SUCCESS
        twist = Twist()
        twist.angular.z = math.copysign(max(0.1, min(get_input(self, "speed"), 2.0 * abs(left))), left)
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
