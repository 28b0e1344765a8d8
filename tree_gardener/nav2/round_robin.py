"""RoundRobin of Nav2."""

from tree_gardener import ControlNode, Port, PortError, Status


class RoundRobin(ControlNode):
    """Ticks the next child each time: after a success, the one after it.

    After a child that fails or is skipped, the next one is ticked in the same tick. Without `wrap_around` the
    last child ends the round: the node fails, whatever that child returned, and starts again at the first.
    """

    MARKS_RUNNING = True
    INPUT_PORTS = {
        "wrap_around": Port(bool, default=False, description="Whether the first follows the last.")
    }

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.index = 0
        self.failed = 0
        self.wraps: bool | None = None

    def update(self) -> Status:
        if self.wraps is None:  # Nav2 reads it once
            try:
                self.wraps = self.get_input("wrap_around")
            except PortError:
                self.wraps = False
        skipped = 0
        while self.failed + skipped < self.child_count:
            status = self.tick_child(self.index)
            if status is Status.RUNNING:
                return Status.RUNNING
            is_last = self.index + 1 == self.child_count
            self.index = 0 if is_last and self.wraps else self.index + 1
            if status is Status.SUCCESS and (self.wraps or not is_last):
                self.failed = 0
                self.halt_children()
                return Status.SUCCESS
            self.failed += status is Status.FAILURE
            skipped += status is Status.SKIPPED
            if is_last and not self.wraps:
                break
        were_all_skipped = skipped == self.child_count
        self.halt()
        return Status.SKIPPED if were_all_skipped else Status.FAILURE

    def halt(self) -> None:
        super().halt()
        self.index = 0
        self.failed = 0
