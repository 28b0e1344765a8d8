from tree_gardener.errors import TickError
from tree_gardener.node import Control
from tree_gardener.status import FAILURE, RUNNING, SKIPPED, SUCCESS, Status


class WhileDoElse(Control):
    """Ticks its first child as a condition at every tick, then one of the others.

    While the condition succeeds the second child is ticked, when it fails the third, and the other one is
    halted; without a third child the node fails. While the condition itself is RUNNING, a RUNNING branch is
    neither ticked nor halted. A condition that is SKIPPED is an error.
    """

    __slots__ = ()

    def execute(self) -> Status:
        count = len(self.ticks)
        if count not in (2, 3):
            raise TickError(self, f"WhileDoElse needs 2 or 3 children and has {count}")
        if self.status is not RUNNING:
            self.start()
        condition = self.ticks[0]()
        if condition is RUNNING:
            return RUNNING
        if condition is SUCCESS:
            if count == 3:
                self.reset_child(2)
            status = self.ticks[1]()
        elif condition is SKIPPED:
            self.reset_children()
            raise TickError(self, "the condition of WhileDoElse was skipped")
        elif count == 3:
            self.reset_child(1)
            status = self.ticks[2]()
        else:
            status = FAILURE
        if status is RUNNING:
            return RUNNING
        return self.finish_skipped() if status is SKIPPED else self.finish(status)
