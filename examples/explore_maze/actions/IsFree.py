import math

import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class IsFree(py_trees.behaviour.Behaviour):
    """Succeeds if the next cell in a direction is open."""

    INPUT_PORTS = {
        "bearing": Port(float, default=0.0, description="The direction in degrees; 90 is left."),
        "within": Port(float, default=1.0, description="A wall nearer than this closes it, in m."),
    }

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.scan = None
        self.subscription = node.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def initialise(self):
        # A scan from before the last turn would show the wrong wall.
        self.scan = None

    def update(self):
        scan = self.scan
        if scan is None:
            return py_trees.common.Status.RUNNING
        bearing = math.radians(get_input(self, "bearing"))
        middle = round((bearing - scan.angle_min) / scan.angle_increment)
        # The median of a few rays: a single one may be noise, or hit the end of a wall.
        seen = sorted(scan.ranges[(middle + i) % len(scan.ranges)] for i in range(-4, 5))
        is_open = seen[4] > get_input(self, "within")
        return py_trees.common.Status.SUCCESS if is_open else py_trees.common.Status.FAILURE
