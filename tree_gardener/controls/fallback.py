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
        ticks, index = self.ticks, self.index
        if self.status is RUNNING:
            status = ticks[index]()
            if status is RUNNING:
                return RUNNING
        else:
            if self.status is IDLE:
                self.skips = 0
            self.status = RUNNING
            if self.journal is not None:
                self.journal.touch(self)
            status = ticks[index]()
        count = len(ticks)
        while True:
            if status is FAILURE:
                pass
            elif status is RUNNING:
                self.index = index
                if self.journal is not None:
                    self.journal.note(self.children)
                return RUNNING
            elif status is SUCCESS:
                self.index = 0
                return self.finish(SUCCESS)
            else:
                self.skips += 1
            index += 1
            if index == count:
                break
            status = ticks[index]()
        self.index = 0
        if self.skips:
            return self.end()
        return self.finish(FAILURE)

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
                self.note_children()
                return RUNNING
            if status is SUCCESS:
                self.index = 0
                return self.finish(SUCCESS)
            self.index += 1
            if status is FAILURE:
                if before is IDLE and self.index < count:
                    self.tree.wake_up = True
                    self.note_children()
                    return RUNNING
            else:
                self.skips += 1
        self.index = 0
        return self.end()
