"""Fallback and AsyncFallback."""

from tree_gardener.node import Control
from tree_gardener.status import FAILURE, IDLE, RUNNING, SUCCESS, Status


class Fallback(Control):
    """Ticks its children in order until one succeeds.

    A RUNNING child is resumed at the next tick. When a child succeeds, all are reset and it succeeds. SKIPPED
    children are passed over; if all of them were, over all ticks of this activation, it is SKIPPED, else
    FAILURE.
    """

    __slots__ = ("index", "skips")

    def prepare(self) -> None:
        super().prepare()
        self.index = 0
        self.skips = 0

    def execute(self) -> Status:
        ticks = self.ticks
        if self.status is RUNNING:
            index = self.index
            tick = ticks[index]
            status = tick()
            return RUNNING if status is RUNNING else self.go_on(index, status)
        if self.status is IDLE:
            self.skips = 0
        self.status = RUNNING
        if self.journal is not None:
            self.journal.touched.append(self)
        index = 0
        for tick in ticks:
            status = tick()
            if status is not FAILURE:
                return self.go_on(index, status)
            index += 1  # noqa: SIM113 - quicker than enumerate()
        return self.finish_all(FAILURE)

    def go_on(self, index: int, status: Status) -> Status:
        """Goes on after the child at `index` returned `status`."""
        ticks = self.ticks
        while True:
            if status is RUNNING:
                self.index = index
                return RUNNING
            if status is SUCCESS:
                self.index = 0
                return self.finish(SUCCESS)
            if status is not FAILURE:
                self.skips += 1
            index += 1
            if index == len(ticks):
                break
            tick = ticks[index]
            status = tick()
        self.index = 0
        return self.end() if self.skips else self.finish(FAILURE)

    def end(self) -> Status:
        """No child succeeded."""
        all_skipped = self.skips == len(self.ticks)
        self.skips = 0
        return self.finish_skipped() if all_skipped else self.finish(FAILURE)

    def halt(self) -> None:
        self.index = 0
        self.skips = 0
        super().halt()


class AsyncFallback(Fallback):
    """A Fallback that returns RUNNING between its children.

    After each child that failed within the tick and is not the last, it wakes the tree up and returns
    RUNNING, so that the tree stays responsive; under ``tick_once`` it still runs through.
    """

    __slots__ = ()

    def execute(self) -> Status:
        if self.status is not RUNNING:
            if self.status is IDLE:
                self.skips = 0
            self.start()
        ticks, children = self.ticks, self.children
        count = len(ticks)
        while self.index < count:
            before = children[self.index].status
            status = ticks[self.index]()
            if status is RUNNING:
                return RUNNING
            if status is SUCCESS:
                self.index = 0
                return self.finish(SUCCESS)
            self.index += 1
            if status is FAILURE:
                if before is IDLE and self.index < count:
                    self.tree.wake_up = True
                    return RUNNING
            else:
                self.skips += 1
        self.index = 0
        return self.end()
