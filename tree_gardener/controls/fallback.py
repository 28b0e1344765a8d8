from tree_gardener.controls.ordered import Ordered, Yielding
from tree_gardener.status import FAILURE, SUCCESS


class Fallback(Ordered):
    """Ticks its children in order until one succeeds.

    A RUNNING child is resumed at the next tick. When a child succeeds, all are reset and it succeeds. SKIPPED
    children are passed over; if all of them were, over all ticks of this activation, it is SKIPPED, else
    FAILURE.
    """

    __slots__ = ()
    GOES_ON = FAILURE
    ENDS = SUCCESS


class AsyncFallback(Yielding):
    """A Fallback that returns RUNNING between its children.

    After each child that failed within the tick and is not the last, it wakes the tree up and returns
    RUNNING, so that the tree stays responsive; under ``tick_once`` it still runs through.
    """

    __slots__ = ()
    GOES_ON = FAILURE
    ENDS = SUCCESS
