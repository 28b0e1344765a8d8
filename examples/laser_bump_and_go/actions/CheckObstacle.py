import math

import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class CheckObstacle(py_trees.behaviour.Behaviour):
    """Succeeds if the LIDAR sees something near, ahead of the robot."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "obs_dist": Port(float, default=1.0, description="How near counts as an obstacle, in m."),
        "amplitude": Port(float, default=30.0, description="How far to each side to look, in degrees."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.scan = None
        self.subscription = node.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def update(self):
        if self.scan is None:
            # Nothing is known yet: stay where we are rather than drive blind.
            return py_trees.common.Status.SUCCESS
        if self.nearest_ahead() < get_input(self, "obs_dist"):
            return py_trees.common.Status.SUCCESS
        return py_trees.common.Status.FAILURE

    def nearest_ahead(self):
        scan = self.scan
        half_width = math.radians(get_input(self, "amplitude"))
        to_each_side = math.floor(half_width / scan.angle_increment + 1e-6)
        front, count = round(-scan.angle_min / scan.angle_increment), len(scan.ranges)
        # A scan goes all the way round, so to the right of its first ray is its last one.
        ahead = [scan.ranges[(front + i) % count] for i in range(-to_each_side, to_each_side + 1)]
        return min((r for r in ahead if scan.range_min <= r <= scan.range_max), default=math.inf)
