"""A robot outside of BT Studio: a plain rclpy program that publishes scans and prints its commands."""

from __future__ import annotations

import math
import sys

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan


class Robot(Node):
    """Publishes scans without obstacles."""

    def __init__(self) -> None:
        super().__init__("outside_robot")
        self._scans = self.create_publisher(LaserScan, "/scan", qos_profile_sensor_data)
        self.create_subscription(Twist, "/cmd_vel", self.on_velocity, 10)
        self.create_timer(0.1, self.measure)
        self._last = math.nan

    def measure(self) -> None:
        scan = LaserScan(angle_min=0.0, angle_increment=math.tau / 360, range_min=0.1, range_max=8.0)
        scan.header.stamp = self.get_clock().now().to_msg()
        scan.ranges = [5.0] * 360
        self._scans.publish(scan)

    def on_velocity(self, twist: Twist) -> None:
        if twist.linear.x != self._last:
            self._last = twist.linear.x
            sys.stdout.write(f"told {twist.linear.x:g}\n")
            sys.stdout.flush()


def main() -> None:
    rclpy.init()
    rclpy.spin(Robot())


if __name__ == "__main__":
    main()
