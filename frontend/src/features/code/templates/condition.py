import py_trees
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import LaserScan

from tree_gardener.ports import Port, get_input


class NewAction(py_trees.behaviour.Behaviour):
    """Succeeds if something is nearer than the limit."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {"limit": Port(float, default=1.0, description="How near counts, in m.")}

    def setup(self, **kwargs):
        node: Node = kwargs["node"]
        self.scan = None
        self.subscription = node.create_subscription(
            LaserScan, "/scan", self.on_scan, qos_profile_sensor_data
        )

    def on_scan(self, scan: LaserScan):
        self.scan = scan

    def update(self):
        if self.scan is not None and min(self.scan.ranges) < get_input(self, "limit"):
            return py_trees.common.Status.SUCCESS
        return py_trees.common.Status.FAILURE
