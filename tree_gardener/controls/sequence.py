from tree_gardener.controls.ordered import Ordered, Yielding
from tree_gardener.status import FAILURE, IDLE, SUCCESS, Status


class Sequence(Ordered):
    """Ticks its children in order.

    A RUNNING child is resumed at the next tick. When a child fails, all children are reset and the Sequence
    fails; the next tick starts at the first child. SKIPPED children are passed over. If all children were
    skipped, over all ticks of this activation, the Sequence is SKIPPED, else it succeeds.
    """

    __slots__ = ()
    GOES_ON = SUCCESS
    ENDS = FAILURE


class AsyncSequence(Yielding):
    """A Sequence that returns RUNNING between its children.

    After each child that succeeded within the tick, except the last one, the node wakes the tree up and
    returns RUNNING, so that the tree stays responsive. Under ``tick_once`` it still runs to its end. It does
    not yield after a child that was RUNNING before, or after a skipped child.
    """

    __slots__ = ()
    GOES_ON = SUCCESS
    ENDS = FAILURE


class SequenceWithMemory(AsyncSequence):
    """A Sequence that starts again at the child that failed.

    It yields between children as AsyncSequence does. When a child fails, that child and those after it are
    halted and the position is kept, also when the node itself is halted; children that succeeded keep their
    SUCCESS.
    """

    __slots__ = ()

    def end_early(self) -> Status:
        for index in range(self.index, len(self.children)):
            self.reset_child(index)
        return self.complete(FAILURE)

    def halt(self) -> None:
        self.reset_children()
        self.status = IDLE
