import math

import py_trees
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input

MIDDLE = 0.6  # m from the middle of a cell to its walls


class DriveCell(py_trees.behaviour.Behaviour):
    """Drives to the middle of the next cell, between the walls beside it."""

    INPUT_PORTS = {
        "length": Port(float, default=1.3, description="How long a cell is, in m."),
        "speed": Port(float, default=0.4, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        quality = qos_profile_sensor_data
        self.scan = self.place = self.start = None
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.ears = [
            node.create_subscription(LaserScan, "/scan", self.on_scan, quality),
            node.create_subscription(Odometry, "/odom", self.on_odometry, quality),
        ]

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def on_odometry(self, odometry: Odometry):
        self.place = (odometry.pose.pose.position.x, odometry.pose.pose.position.y)

    def initialise(self):
        self.start = self.place

    def at(self, degrees):
        scan = self.scan
        return scan.ranges[
            round((math.radians(degrees) - scan.angle_min) / scan.angle_increment) % len(scan.ranges)
        ]

    def update(self):
        self.start = self.start or self.place
        if self.start is None or self.place is None:
            return py_trees.common.Status.RUNNING  # nothing of the wheels has come yet
        left = get_input(self, "length") - math.dist(self.start, self.place)
        if self.at(0) < 1.2:  # the wall ahead says it better than the wheels
            left = self.at(0) - MIDDLE
        if left <= 0.02:
            return py_trees.common.Status.SUCCESS
        # The nearer wall beside the robot keeps it in the middle, the two oblique rays to it parallel.
        sides = [(self.at(s * 60), self.at(s * 90), s) for s in (1, -1)]
        oblique, beside, side = min(sides, key=lambda seen: seen[1])
        twist = Twist()
        twist.linear.x = max(0.05, min(get_input(self, "speed"), 1.5 * left))
        if beside < 0.9 and oblique < 1.4:
            askew = oblique * math.sin(math.radians(60)) - beside  # more than 0: the wall runs away ahead
            twist.angular.z = side * max(-0.6, min(0.6, 1.2 * (beside - MIDDLE) + 2.0 * askew))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
