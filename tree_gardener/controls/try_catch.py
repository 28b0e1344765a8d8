from tree_gardener.node import Control
from tree_gardener.status import FAILURE, IDLE, RUNNING, SUCCESS, Status


class TryCatch(Control):
    """Ticks all but its last child as a Sequence; when one fails, ticks the last, then fails.

    The last child is ticked in the same tick, and until it is not RUNNING; the result is FAILURE for every
    result of this child. If all other children were skipped, the node is SKIPPED. With `catch_on_halt`, a
    halt of the node during the first children halts them and ticks the last child once.
    """

    __slots__ = ("catching", "index", "skips")

    def prepare(self) -> None:
        super().prepare()
        self.forget()

    def forget(self) -> None:
        self.index = 0
        self.skips = 0
        self.catching = False

    def execute(self) -> Status:
        if self.status is not RUNNING:
            if self.status is IDLE:
                self.skips = 0
            self.start()
        if self.catching:
            return self.catch()
        last = len(self.ticks) - 1
        while self.index < last:
            status = self.ticks[self.index]()
            if status is RUNNING:
                return RUNNING
            if status is FAILURE:
                for index in range(last):
                    self.reset_child(index)
                self.index = 0
                self.catching = True
                return self.catch()
            self.index += 1
            if status is not SUCCESS:
                self.skips += 1
        all_skipped = self.skips == last
        self.forget()
        return self.finish_skipped() if all_skipped else self.finish(SUCCESS)

    def catch(self) -> Status:
        if self.ticks[-1]() is RUNNING:
            return RUNNING
        self.index = 0
        self.catching = False
        return self.finish(
            FAILURE
        )  # as there, a parent that does not reset the node keeps its count of skips

    def halt(self) -> None:
        if not self.catching and self.status is RUNNING and self.get_or("catch_on_halt", otherwise=False):
            last = len(self.children) - 1
            for index in range(last):
                self.reset_child(index)
            self.ticks[-1]()
        self.forget()
        super().halt()
