import math

import py_trees
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, set_output


class FindBox(py_trees.behaviour.Behaviour):
    """Outputs the place of the nearest thing that the LIDAR sees: the box."""

    OUTPUT_PORTS = {
        "x": Port(float, description="Where the box is, in m, in the frame of the odometry."),
        "y": Port(float, description="Where the box is, in m, in the frame of the odometry."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        quality = qos_profile_sensor_data
        self.scan = self.pose = None
        self.ears = [
            node.create_subscription(LaserScan, "/scan", self.on_scan, quality),
            node.create_subscription(Odometry, "/odom", self.on_odometry, quality),
        ]

    def on_scan(self, scan: LaserScan):
        # The place from which was measured belongs to the measurement.
        self.scan, self.seen_from = scan, self.pose

    def on_odometry(self, odometry: Odometry):
        place, turn = odometry.pose.pose.position, odometry.pose.pose.orientation
        self.pose = (place.x, place.y, 2 * math.atan2(turn.z, turn.w))

    def initialise(self):
        self.scan = None

    def update(self):
        if self.scan is None or self.seen_from is None:
            return py_trees.common.Status.RUNNING
        ranges, (x, y, heading) = self.scan.ranges, self.seen_from
        nearest = min(distance for distance in ranges if distance >= self.scan.range_min)
        seen = [i for i, distance in enumerate(ranges) if distance < nearest + 0.25]
        bearings = [heading + self.scan.angle_min + i * self.scan.angle_increment for i in seen]
        # The hits are on its faces; its middle is a hand's breadth behind their mean.
        points = [(ranges[i] + 0.15, bearing) for i, bearing in zip(seen, bearings, strict=True)]
        set_output(self, "x", x + sum(r * math.cos(b) for r, b in points) / len(points))
        set_output(self, "y", y + sum(r * math.sin(b) for r, b in points) / len(points))
        return py_trees.common.Status.SUCCESS
