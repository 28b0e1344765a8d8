import math

import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class WallAhead(py_trees.behaviour.Behaviour):
    """Succeeds if something is near ahead."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {"distance": Port(float, default=0.7, description="How near is near, in m.")}

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.scan = None
        self.subscription = node.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def nearest(self, low, high):
        """Returns the nearest distance between two bearings in degrees; positive is left."""
        scan, found = self.scan, math.inf
        for i, distance in enumerate(scan.ranges):
            bearing = math.degrees(math.remainder(scan.angle_min + i * scan.angle_increment, math.tau))
            if low <= bearing <= high and distance >= scan.range_min:
                found = min(found, distance)
        return found

    def update(self):
        if self.scan is None:
            return py_trees.common.Status.FAILURE
        is_near = self.nearest(-25, 25) < get_input(self, "distance")
        return py_trees.common.Status.SUCCESS if is_near else py_trees.common.Status.FAILURE
