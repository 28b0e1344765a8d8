import math

import py_trees
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node

from tree_gardener.ports import Port, get_input


class Drive(py_trees.behaviour.Behaviour):
    """Drives one of the robots straight ahead, or back, until a distance is covered."""

    INPUT_PORTS = {
        "robot": Port(str, default="", description="Its topics' prefix: nothing for the first, /helper."),
        "distance": Port(float, default=1.0, description="How far, in m; negative is backwards."),
        "speed": Port(float, default=0.25, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        # Each robot has topics of its own: /cmd_vel of the first, /helper/cmd_vel of the second.
        node: Node = kwargs["node"]
        robot = get_input(self, "robot")
        self.place = self.start = None
        self.publisher = node.create_publisher(Twist, f"{robot}/cmd_vel", 10)
        self.subscription = node.create_subscription(Odometry, f"{robot}/odom", self.on_odometry, 10)

    def on_odometry(self, odometry: Odometry):
        self.place = (odometry.pose.pose.position.x, odometry.pose.pose.position.y)

    def initialise(self):
        self.start = self.place

    def update(self):
        self.start = self.start or self.place
        if self.start is None or self.place is None:
            return py_trees.common.Status.RUNNING
        distance, speed = get_input(self, "distance"), get_input(self, "speed")
        left = abs(distance) - math.dist(self.start, self.place)
        twist = Twist()
        if left > 0.01:
            twist.linear.x = math.copysign(max(0.05, min(speed, 1.5 * left)), distance)
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING if left > 0.01 else py_trees.common.Status.SUCCESS

    def terminate(self, new_status):
        self.publisher.publish(Twist())
