import math

import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class AvoidObstacles(py_trees.behaviour.Behaviour):
    """Drives around without touching anything, towards the free side, until it is halted."""

    INPUT_PORTS = {
        "distance": Port(float, default=0.8, description="From where on obstacles are avoided, in m."),
        "speed": Port(float, default=0.35, description="Speed in m/s where the way is free."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.scan = None
        self.turning = 0
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.subscription = node.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def nearest(self, low, high):
        """Returns the nearest distance between two bearings in degrees.

        If there is none, the largest range.
        """
        scan, found = self.scan, self.scan.range_max
        for i, distance in enumerate(scan.ranges):
            bearing = math.degrees(math.remainder(scan.angle_min + i * scan.angle_increment, math.tau))
            if low <= bearing <= high and scan.range_min <= distance < found:
                found = distance
        return found

    def update(self):
        if self.scan is None:
            return py_trees.common.Status.RUNNING
        left, right = self.nearest(0, 50), self.nearest(-50, 0)
        near = get_input(self, "distance")
        twist = Twist()
        if min(left, right) >= near:
            self.turning = 0
            twist.linear.x = get_input(self, "speed")
        else:
            # The side is chosen once: changing it with every scan would rock the robot in corners.
            self.turning = self.turning or (1 if left > right else -1)
            twist.angular.z = 0.9 * self.turning
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
