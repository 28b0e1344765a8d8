from tree_gardener.errors import TickError
from tree_gardener.node import Control
from tree_gardener.status import FAILURE, RUNNING, SKIPPED, SUCCESS, Status


class IfThenElse(Control):
    """Ticks its first child as a condition, then one of the others.

    When the condition succeeds the second child is chosen, when it fails the third; without a third child the
    node fails. The choice holds until that child is done: the condition is not ticked again while it is
    RUNNING. A condition that is SKIPPED is an error.
    """

    __slots__ = ("chosen",)

    def prepare(self) -> None:
        super().prepare()
        self.chosen = 0

    def execute(self) -> Status:
        count = len(self.ticks)
        if count not in (2, 3):
            raise TickError(self, f"IfThenElse needs 2 or 3 children and has {count}")
        if self.status is not RUNNING:
            self.start()
        if self.chosen == 0:
            condition = self.ticks[0]()
            if condition is RUNNING:
                return RUNNING
            if condition is SKIPPED:
                raise TickError(self, "the condition of IfThenElse was skipped")
            if condition is SUCCESS:
                self.chosen = 1
            elif count == 3:
                self.chosen = 2
            else:
                return self.complete(FAILURE)
        status = self.ticks[self.chosen]()
        if status is RUNNING:
            return RUNNING
        self.chosen = 0
        return self.finish_skipped() if status is SKIPPED else self.finish(status)

    def halt(self) -> None:
        self.chosen = 0
        super().halt()
