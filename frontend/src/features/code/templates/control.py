from tree_gardener import ControlNode, Port, Status


class NewAction(ControlNode):
    """Ticks its children in order until one succeeds; gives up after some failures in one tick."""

    INPUT_PORTS = {"limit": Port(int, default=3, description="The number of failures.")}

    def update(self):
        for index in range(min(self.child_count, self.get_input("limit"))):
            status = self.tick_child(index)
            if status is Status.RUNNING:
                return Status.RUNNING
            if status is Status.SUCCESS:
                self.halt_children()
                return Status.SUCCESS
        self.halt_children()
        return Status.FAILURE
