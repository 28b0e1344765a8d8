import py_trees
from rclpy.node import Node

from tree_gardener.ports import Port, get_input, set_output


class UseBattery(py_trees.behaviour.Behaviour):
    """Takes a little from a battery in each tick, and fails when it is empty."""

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {"lasts": Port(float, default=60.0, description="How long a full battery lasts, in s.")}
    INOUT_PORTS = {"battery": Port(float, default="{battery}", description="Its charge, from 0 to 100.")}

    def setup(self, **kwargs):
        self.node: Node = kwargs["node"]
        self.last_s = None

    def update(self):
        now_s = self.node.get_clock().now().nanoseconds / 1e9
        passed_s = 0.0 if self.last_s is None else now_s - self.last_s
        charge = 100.0 if self.last_s is None else get_input(self, "battery")
        self.last_s = now_s
        # The real battery of the robot lasts for hours: this one is small, so that one can watch it.
        charge = max(0.0, charge - 100.0 * passed_s / get_input(self, "lasts"))
        set_output(self, "battery", charge)
        return py_trees.common.Status.SUCCESS if charge > 0 else py_trees.common.Status.FAILURE
