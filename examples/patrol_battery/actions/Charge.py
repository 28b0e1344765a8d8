import py_trees
from rclpy.node import Node

from tree_gardener.ports import Port, get_input, set_output


class Charge(py_trees.behaviour.Behaviour):
    """Charges the battery until it is halted: `NeedsCharge` decides when it is enough."""

    INPUT_PORTS = {"rate": Port(float, default=15.0, description="How much is charged in a second, of 100.")}
    INOUT_PORTS = {"battery": Port(float, default="{battery}", description="Its charge, from 0 to 100.")}

    def setup(self, **kwargs):
        self.node: Node = kwargs["node"]

    def now_s(self):
        return self.node.get_clock().now().nanoseconds / 1e9

    def initialise(self):
        print(f"At the dock with {get_input(self, 'battery'):.0f} % left: charging")
        self.last_s = self.now_s()

    def update(self):
        passed_s, self.last_s = self.now_s() - self.last_s, self.now_s()
        charge = get_input(self, "battery") + get_input(self, "rate") * passed_s
        set_output(self, "battery", min(100.0, charge))
        return py_trees.common.Status.RUNNING
