import py_trees

from tree_gardener.ports import Port, get_input


class NeedsCharge(py_trees.behaviour.Behaviour):
    """Succeeds from when the battery is low until it is full."""

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "battery": Port(float, default="{battery}", description="The charge, from 0 to 100."),
        "low": Port(float, default=35.0, description="Below this it needs to be charged."),
        "full": Port(float, default=95.0, description="Above this it is charged enough."),
    }

    def setup(self, **kwargs):
        self.is_low = False

    def update(self):
        charge = get_input(self, "battery")
        # Two limits: with one, the robot would leave the dock with the first drop and come back at once.
        limit = get_input(self, "full" if self.is_low else "low")
        self.is_low = charge < limit
        return py_trees.common.Status.SUCCESS if self.is_low else py_trees.common.Status.FAILURE
