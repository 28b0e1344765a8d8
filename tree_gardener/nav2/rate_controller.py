"""RateController of Nav2."""

import math

from tree_gardener import DecoratorNode, Port, PortError, Status


class RateController(DecoratorNode):
    """Ticks its child at most `hz` times a second; in between it is RUNNING.

    The child is ticked immediately when the node starts, and at every tick while it is RUNNING. The time
    counts from the start, and later from the child's last success.
    """

    INPUT_PORTS = {"hz": Port(float, default=10.0, description="Times a second.")}

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.start_s = 0.0
        self.period_s = 0.0
        self.is_first = False

    def update(self) -> Status:
        if self.status is Status.IDLE:
            self.begin()
        self.mark_running()
        # A tolerance, because seconds in floats do not add up.
        is_due = self.now() - self.start_s >= self.period_s - 1e-9
        if not (self.is_first or is_due or self.child_status() is Status.RUNNING):
            return Status.RUNNING
        self.is_first = False
        status = self.tick_child()
        if status is Status.SUCCESS:
            self.start_s = self.now()
        return status

    def begin(self) -> None:
        """Reads the rate, which is valid until the node is IDLE again, and starts the time."""
        try:
            hz = self.get_input("hz")
        except PortError:
            hz = 1.0
        self.period_s = 1.0 / hz if hz else math.inf
        self.start_s = self.now()
        self.is_first = True
