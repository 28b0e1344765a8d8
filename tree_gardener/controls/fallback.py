from tree_gardener.controls.ordered import Ordered, Yielding
from tree_gardener.status import FAILURE, SUCCESS


class Fallback(Ordered):
    """Ticks its children in order until one succeeds.

    A RUNNING child is resumed at the next tick. When a child succeeds, all children are reset, and the
    Fallback succeeds. SKIPPED children are passed over. If all children were skipped, over all ticks of this
    activation, the Fallback is SKIPPED, else it fails.
    """

    __slots__ = ()
    GOES_ON = FAILURE
    ENDS = SUCCESS


class AsyncFallback(Yielding):
    """A Fallback that returns RUNNING between its children.

    After each child that failed within the tick, except the last one, the node wakes the tree up and returns
    RUNNING, so that the tree stays responsive. Under ``tick_once`` it still runs to its end.
    """

    __slots__ = ()
    GOES_ON = FAILURE
    ENDS = SUCCESS
