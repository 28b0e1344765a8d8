"""Sequence, AsyncSequence and SequenceWithMemory."""

from typing import ClassVar

from tree_gardener.node import Control
from tree_gardener.status import FAILURE, IDLE, RUNNING, SUCCESS, Status


class Sequence(Control):
    """Ticks its children in order.

    A RUNNING child is resumed at the next tick. When a child fails, all are reset and it fails; the next tick
    starts at the first child. SKIPPED children are passed over; if all of them were, over all ticks of this
    activation, it is SKIPPED, else SUCCESS.
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
            if status is not SUCCESS:
                return self.go_on(index, status)
            index += 1  # noqa: SIM113 - quicker than enumerate()
        return self.finish_all(SUCCESS)

    def go_on(self, index: int, status: Status) -> Status:
        """Goes on after the child at `index` returned `status`."""
        ticks = self.ticks
        while True:
            if status is RUNNING:
                self.index = index
                return RUNNING
            if status is FAILURE:
                self.index = 0
                return self.finish(FAILURE)
            if status is not SUCCESS:
                self.skips += 1
            index += 1
            if index == len(ticks):
                break
            tick = ticks[index]
            status = tick()
        self.index = 0
        return self.end_with_skips() if self.skips else self.finish(SUCCESS)

    def end_with_skips(self) -> Status:
        """The end of an activation in which children were skipped."""
        all_skipped = self.skips == len(self.ticks)
        self.skips = 0
        return self.finish_skipped() if all_skipped else self.finish(SUCCESS)

    def halt(self) -> None:
        self.index = 0
        self.skips = 0
        super().halt()


class YieldingSequence(Sequence):
    """A Sequence that yields: after a child that succeeded at once it wakes the tree and is RUNNING."""

    __slots__ = ()
    KEEPS_INDEX: ClassVar[bool] = False

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
            if status is FAILURE:
                return self.fail()
            self.index += 1
            if status is SUCCESS:
                if before is IDLE and self.index < count:
                    self.tree.wake_up = True
                    return RUNNING
            else:
                self.skips += 1
        self.index = 0
        return self.end_with_skips()

    def fail(self) -> Status:
        """What happens when a child failed."""
        self.index = 0
        return self.finish(FAILURE)


class AsyncSequence(YieldingSequence):
    """A Sequence that returns RUNNING between its children.

    After each child that succeeded within the tick and is not the last, it wakes the tree up and returns
    RUNNING, so that the tree stays responsive; under ``tick_once`` it still runs through. It does not yield
    after a child that was RUNNING before, nor after a skipped one.
    """

    __slots__ = ()


class SequenceWithMemory(YieldingSequence):
    """A Sequence that starts again at the child that failed.

    It yields between children as AsyncSequence does. When a child fails, that child and those after it are
    halted and the position is kept, also when the node itself is halted; children that succeeded keep their
    SUCCESS.
    """

    __slots__ = ()

    def fail(self) -> Status:
        for index in range(self.index, len(self.children)):
            self.reset_child(index)
        return self.complete(FAILURE)

    def halt(self) -> None:
        self.reset_children()
        self.status = IDLE
