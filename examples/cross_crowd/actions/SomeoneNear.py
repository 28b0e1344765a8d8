import math

import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input, set_output


class SomeoneNear(py_trees.behaviour.Behaviour):
    """Succeeds if the LIDAR sees something near, and tells in which direction it is."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "distance": Port(float, default=0.7, description="How near is near, in m."),
        "angle": Port(float, default=180.0, description="How far to each side to look, in degrees."),
    }
    OUTPUT_PORTS = {"bearing": Port(float, description="Where the nearest is, in rad; positive is left.")}

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
            return py_trees.common.Status.FAILURE
        nearest, widest = math.inf, math.radians(get_input(self, "angle"))
        for i, distance in enumerate(self.scan.ranges):
            bearing = math.remainder(self.scan.angle_min + i * self.scan.angle_increment, math.tau)
            if abs(bearing) <= widest and self.scan.range_min <= distance < nearest:
                nearest = distance
                set_output(self, "bearing", bearing)
        is_near = nearest < get_input(self, "distance")
        return py_trees.common.Status.SUCCESS if is_near else py_trees.common.Status.FAILURE
