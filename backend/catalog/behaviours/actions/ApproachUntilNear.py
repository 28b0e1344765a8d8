import math

import py_trees
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class ApproachUntilNear(py_trees.behaviour.Behaviour):
    """Drives slowly ahead until the LIDAR measures an obstacle near enough."""

    INPUT_PORTS = {
        "distance": Port(float, default=0.4, description="Where to stop, in m from the LIDAR."),
        "speed": Port(float, default=0.15, description="Speed in m/s."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.scan = None
        self.publisher = node.create_publisher(Twist, "/cmd_vel", 10)
        self.subscription = node.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def update(self):
        scan = self.scan
        if scan is None:
            return py_trees.common.Status.RUNNING
        ahead = (
            distance
            for i, distance in enumerate(scan.ranges)
            if abs(math.remainder(scan.angle_min + i * scan.angle_increment, math.tau)) < 0.15
            and distance >= scan.range_min
        )
        left = min(ahead, default=math.inf) - get_input(self, "distance")
        if left <= 0.01:
            return py_trees.common.Status.SUCCESS
        twist = Twist()
        twist.linear.x = max(0.03, min(get_input(self, "speed"), left))
        self.publisher.publish(twist)
        return py_trees.common.Status.RUNNING

    def terminate(self, new_status):
        self.publisher.publish(Twist())
