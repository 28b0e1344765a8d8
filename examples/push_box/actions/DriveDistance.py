import math

import py_trees
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class DriveDistance(py_trees.behaviour.Behaviour):
    """Drives straight until a distance is covered; a negative one drives backwards."""

    INPUT_PORTS = {
        "distance": Port(float, default=1.0, description="How far, in m; negative is backwards."),
        "speed": Port(float, default=0.3, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.place = None
        self.start = None
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.subscription = node.create_subscription(Odometry, "/odom", self.on_odometry, 10)

    def on_odometry(self, odometry: Odometry):
        position = odometry.pose.pose.position
        self.place = (position.x, position.y)

    def initialise(self):
        self.start = None

    def update(self):
        if self.place is None:
            return py_trees.common.Status.RUNNING
        self.start = self.start or self.place
        distance = get_input(self, "distance")
        left = abs(distance) - math.dist(self.start, self.place)
        if left <= 0.01:
            return py_trees.common.Status.SUCCESS
        twist = Twist()
        # The last part is driven slowly, so that the robot stops at the right place.
        speed = max(0.05, min(get_input(self, "speed"), 1.5 * left))
        twist.linear.x = math.copysign(speed, distance)
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
