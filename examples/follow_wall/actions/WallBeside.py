import math

import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input, set_output


class WallBeside(py_trees.behaviour.Behaviour):
    """Succeeds if a wall is on the left, and tells how far it is."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {"within": Port(float, default=1.1, description="How far a wall may be, in m.")}
    OUTPUT_PORTS = {"gap": Port(float, description="How far the wall is, in m.")}

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
        # The oblique beam sees early that the wall bends; beside a straight wall it is √2 times as long.
        gap = min(self.nearest(70, 110), self.nearest(40, 50) / math.sqrt(2))
        set_output(self, "gap", gap)
        is_near = gap < get_input(self, "within")
        return py_trees.common.Status.SUCCESS if is_near else py_trees.common.Status.FAILURE
