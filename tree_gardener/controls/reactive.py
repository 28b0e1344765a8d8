from typing import ClassVar

from tree_gardener.node import Control, Node
from tree_gardener.status import FAILURE, IDLE, RUNNING, SUCCESS, Status


class _Reactive(Control):
    """Ticks its children from the first at every tick.

    It continues after a child that returned `GOES_ON`, and ends at a child that returned `ENDS`. A SKIPPED
    child is halted immediately; if all were skipped in this tick, the result is SKIPPED, else `GOES_ON`.
    """

    __slots__ = ()
    GOES_ON: ClassVar[Status]
    ENDS: ClassVar[Status]

    def execute(self) -> Status:
        quick = self.quick
        if quick is not None:
            return quick()  # type: ignore[no-any-return]
        if self.status is not RUNNING:
            self.status = RUNNING
            if self.journal is not None:
                self.journal.touched.append(self)
        goes_on = self.GOES_ON
        index = 0
        for tick in self.ticks:
            status = tick()
            if status is not goes_on:
                return self.go_on(index, status)
            index += 1  # noqa: SIM113 - quicker than enumerate()
        return self.finish(goes_on)

    def begin(self) -> None:
        """Starts a tick in which generated code ticks the children."""
        if self.status is not RUNNING:
            self.start()

    def end(self, _called: tuple[Node, ...]) -> Status:
        """Ends a tick in which all children returned `GOES_ON` to generated code."""
        return self.finish(self.GOES_ON)

    def go_on(self, index: int, status: Status) -> Status:
        """Continues after the child at `index` returned `status`, and those before it `GOES_ON`."""
        ticks, goes_on, ends = self.ticks, self.GOES_ON, self.ENDS
        all_skipped = index == 0
        while True:
            if status is goes_on:
                all_skipped = False
            elif status is RUNNING:
                return self.running_at(index)
            elif status is ends:
                return self.finish(ends)
            else:
                self.reset_child(index)
            index += 1
            if index == len(ticks):
                return self.finish_skipped() if all_skipped else self.finish(goes_on)
            tick = ticks[index]
            status = tick()

    def running_at(self, index: int) -> Status:
        """Halts all children except the RUNNING one; the earlier ones too, so that they start again."""
        if self.journal is not None:
            self.journal.reset([child for position, child in enumerate(self.children) if position != index])
            return RUNNING
        for position, child in enumerate(self.children):
            if position != index and child.status is not IDLE:
                if child.status is RUNNING:
                    child.stop()
                child.status = IDLE
        return RUNNING


class ReactiveSequence(_Reactive):
    """A Sequence that ticks all its children from the first at every tick.

    When a child is RUNNING, all others are halted and the node is RUNNING. When a child fails, all are reset
    and the node fails. A SKIPPED child is halted immediately. If all were skipped in this tick, the node is
    SKIPPED, else it succeeds.
    """

    __slots__ = ()
    GOES_ON = SUCCESS
    ENDS = FAILURE


class ReactiveFallback(_Reactive):
    """A Fallback that tries all its children from the first at every tick.

    When a child is RUNNING, all others are halted and the node is RUNNING. When a child succeeds, all are
    reset and the node succeeds. A SKIPPED child is halted immediately. If all were skipped in this tick, the
    node is SKIPPED, else it fails.
    """

    __slots__ = ()
    GOES_ON = FAILURE
    ENDS = SUCCESS
