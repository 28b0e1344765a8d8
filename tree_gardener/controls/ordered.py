"""The rule of sequences and fallbacks, which are the same with SUCCESS and FAILURE exchanged."""

from typing import ClassVar

from tree_gardener.node import Control, Node
from tree_gardener.status import IDLE, RUNNING, Status


class Ordered(Control):
    """Ticks its children in order: a child's result `GOES_ON` continues, `ENDS` ends the node.

    A RUNNING child is resumed at the next tick. When a child ends the node, all children are reset, and the
    next tick starts at the first. SKIPPED children are passed over. If all children were skipped, over all
    ticks of this activation, the result is SKIPPED, else `GOES_ON`.
    """

    __slots__ = ("index", "skips")
    GOES_ON: ClassVar[Status]
    ENDS: ClassVar[Status]

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
        quick = self.quick
        if quick is not None:
            return quick()  # type: ignore[no-any-return]
        if self.status is IDLE:
            self.skips = 0
        self.status = RUNNING
        if self.journal is not None:
            self.journal.touched.append(self)
        goes_on = self.GOES_ON
        index = 0
        for tick in ticks:
            status = tick()
            if status is not goes_on:
                return self.go_on(index, status)
            index += 1  # noqa: SIM113 - quicker than enumerate()
        return self.finish_all(goes_on)

    def begin(self) -> None:
        """Starts an activation whose children generated code ticks."""
        if self.status is IDLE:
            self.skips = 0
        self.start()

    def end(self, called: tuple[Node, ...]) -> Status:
        """Ends an activation in which all children returned `GOES_ON` to generated code.

        Only those in `called` can have resets that are not reported yet.
        """
        for child in self.children:
            child.status = IDLE
        journal = self.journal
        if journal is not None:
            journal.reset_done(called)
        return self.complete(self.GOES_ON)

    def go_on(self, index: int, status: Status) -> Status:
        """Continues after the child at `index` returned `status`."""
        ticks, goes_on, ends = self.ticks, self.GOES_ON, self.ENDS
        while True:
            if status is RUNNING:
                self.index = index
                return RUNNING
            if status is ends:
                self.index = 0
                return self.finish(ends)
            if status is not goes_on:
                self.skips += 1
            index += 1
            if index == len(ticks):
                break
            tick = ticks[index]
            status = tick()
        self.index = 0
        return self.end_with_skips() if self.skips else self.finish(goes_on)

    def end_with_skips(self) -> Status:
        """Ends an activation in which children were skipped."""
        all_skipped = self.skips == len(self.ticks)
        self.skips = 0
        return self.finish_skipped() if all_skipped else self.finish(self.GOES_ON)

    def halt(self) -> None:
        self.index = 0
        self.skips = 0
        super().halt()


class Yielding(Ordered):
    """Yields after a child that returned `GOES_ON` within one tick: wakes the tree up and is RUNNING.

    It does not yield after the last child, after a child that was RUNNING before, or after a skipped child.
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
            if status is self.ENDS:
                return self.end_early()
            self.index += 1
            if status is self.GOES_ON:
                if before is IDLE and self.index < count:
                    self.tree.wake_up = True
                    return RUNNING
            else:
                self.skips += 1
        self.index = 0
        return self.end_with_skips()

    def end_early(self) -> Status:
        """Ends the activation after a child returned `ENDS`."""
        self.index = 0
        return self.finish(self.ENDS)
