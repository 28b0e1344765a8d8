from tree_gardener import DecoratorNode, Port, Status


class NewAction(DecoratorNode):
    """Ticks its child at most once in some seconds; in between it is skipped."""

    INPUT_PORTS = {"period_s": Port(float, default=1.0, description="Seconds between two ticks.")}

    def __init__(self, name):
        super().__init__(name)
        self.due_s = 0.0

    def update(self):
        if self.child_status() is not Status.RUNNING and self.now() < self.due_s:
            return Status.SKIPPED
        self.due_s = self.now() + self.get_input("period_s")
        return self.tick_child()
