"""TimeExpired of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or, is_active, now
from tree_gardener.ports import Port


class TimeExpired(Behaviour):
    """Succeeds once each time that `seconds` have passed; in between it fails.

    The time counts from the start, at which the node fails, and later from each success. `seconds` is read at
    the start. Rule: Nav2's plugins/condition/time_expired_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {"seconds": Port(float, default=1.0, description="The time, in s.")}

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.period_s = 1.0
        self.start_s = 0.0

    def update(self) -> Status:
        if not is_active(self):
            self.period_s = input_or(self, "seconds", self.period_s)
            self.start_s = now(self)
            return Status.FAILURE
        # A tolerance, because seconds in floats do not add up.
        if now(self) - self.start_s < self.period_s - 1e-9:
            return Status.FAILURE
        self.start_s = now(self)
        return Status.SUCCESS
