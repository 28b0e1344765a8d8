"""PathLongerOnApproach of Nav2."""

from typing import Any

from tree_gardener import DecoratorNode, Port, Status
from tree_gardener.nav2.geometry import path_length
from tree_gardener.nav2.reading import input_or


class PathLongerOnApproach(DecoratorNode):
    """Ticks its child when a new path to the same goal is much longer, near the goal; else it succeeds.

    The child is ticked if the new path ends where the old one did and has another number of poses, the old
    one is shorter than `prox_len`, and the new one is longer than `length_factor` times the old one. While
    the child is RUNNING or skipped, the old path is kept. The first path never ticks the child. Rule: Nav2's
    plugins/decorator/path_longer_on_approach.cpp.
    """

    INPUT_PORTS = {
        "path": Port(description="The path."),
        "prox_len": Port(float, default=3.0, description="The length that counts as near, in m."),
        "length_factor": Port(float, default=2.0, description="How many times longer the new path must be."),
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.new: Any = None
        self.old: Any = None
        self.prox_len = 3.0
        self.length_factor = 2.0
        self.is_first = True

    def update(self) -> Status:
        self.new = input_or(self, "path", self.new)
        self.prox_len = input_or(self, "prox_len", self.prox_len)
        self.length_factor = input_or(self, "length_factor", self.length_factor)
        new, old = _poses(self.new), _poses(self.old)
        if not old or not new or old[-1].pose != new[-1].pose:
            self.is_first = True
        self.mark_running()
        if not self.is_first and self.is_longer(new, old):
            status = self.tick_child()
            if status in {Status.SUCCESS, Status.FAILURE}:
                self.old = self.new
            return status
        self.old = self.new
        self.is_first = False
        return Status.SUCCESS

    def is_longer(self, new: list[Any], old: list[Any]) -> bool:
        """Returns whether the new path is an update of the old, short one, and much longer."""
        length = path_length(old)
        return (
            len(new) != len(old) and length < self.prox_len and path_length(new) > self.length_factor * length
        )


def _poses(path: Any) -> list[Any]:
    return [] if path is None else path.poses
