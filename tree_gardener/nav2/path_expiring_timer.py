"""PathExpiringTimer of Nav2."""

from typing import Any

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import input_or, now
from tree_gardener.ports import Port


class PathExpiringTimer(Behaviour):
    """Succeeds once each time that `seconds` have passed without a new path; in between it fails.

    The time counts from the node's first tick in the life of the tree, at which it fails, and again from each
    change of the path and each success. `seconds` is read at the first tick. Rule: Nav2's
    plugins/condition/path_expiring_timer_condition.cpp.
    """

    NODE_KIND = "Condition"
    INPUT_PORTS = {
        "seconds": Port(float, default=1.0, description="The time, in s."),
        "path": Port(description="The path; a change of it starts the time again."),
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.path: Any = None
        self.period_s = 1.0
        self.start_s: float | None = None

    def update(self) -> Status:
        path = input_or(self, "path", None)
        if self.start_s is None:
            self.period_s = input_or(self, "seconds", self.period_s)
            self.path, self.start_s = path, now(self)
            return Status.FAILURE
        if path != self.path:
            self.path, self.start_s = path, now(self)
        # A tolerance, because seconds in floats do not add up.
        if now(self) - self.start_s < self.period_s - 1e-9:
            return Status.FAILURE
        self.start_s = now(self)
        return Status.SUCCESS
