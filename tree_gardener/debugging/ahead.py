"""The nodes that the rules may still tick in the tick in progress: possible ones, not certain ones.

The answer holds for one tick of the root. A condition that skips a node, or a result that ends its parent, is
not foreseen, so that every node that is ticked later in the tick is in it.
"""

from collections.abc import Iterable, Sequence
from typing import Final

from tree_gardener.controls.if_then_else import IfThenElse
from tree_gardener.controls.ordered import Ordered
from tree_gardener.controls.parallel import Parallel, ParallelAll
from tree_gardener.controls.reactive import ReactiveFallback, ReactiveSequence
from tree_gardener.controls.switch import Switch
from tree_gardener.controls.try_catch import TryCatch
from tree_gardener.controls.while_do_else import WhileDoElse
from tree_gardener.debugging.stepper import Event, Shape
from tree_gardener.decorators.loop import Loop
from tree_gardener.decorators.precondition import Precondition
from tree_gardener.decorators.result import ForceFailure, ForceSuccess, Inverter, KeepRunningUntilFailure
from tree_gardener.decorators.run_once import RunOnce
from tree_gardener.decorators.subtree import SubTree
from tree_gardener.decorators.timing import Delay, Timeout
from tree_gardener.decorators.update import SkipUnlessUpdated, WaitValueUpdate
from tree_gardener.node import Node
from tree_gardener.status import RUNNING

LATER: Final = (Ordered, ReactiveSequence, ReactiveFallback, Parallel, ParallelAll)
"""Nodes that tick children in order, each at most once in a tick."""
CHOOSING: Final = (IfThenElse, WhileDoElse)
"""Nodes that tick their first child and then one of the others."""
ONCE: Final = (
    *(Switch, Loop, Precondition, ForceFailure, ForceSuccess, Inverter, KeepRunningUntilFailure, RunOnce),
    *(SubTree, Delay, Timeout, SkipUnlessUpdated, WaitValueUpdate),
)
"""Nodes that tick one child once in a tick."""


def ahead(nodes: Sequence[Node], shape: Shape, uid: int, event: Event) -> tuple[int, ...]:
    """Returns the uids of the nodes that may still be ticked in this tick, in pre-order.

    Args:
        nodes: all nodes, in pre-order.
        shape: their shape.
        uid: the node at which the tree is held.
        event: the event there. Before its tick, the node and those below it are ahead, too. A node that halts
            one child may tick another one afterwards.
    """
    found: set[int] = set()
    if event is Event.BEFORE:
        found.update(range(uid, shape.last[uid] + 1))
    node = nodes[uid - 1]
    while node.parent is not None:
        position = node.parent.children.index(node)
        for child in _children_ahead(node.parent, position, is_halt=event is Event.HALTED):
            found.update(range(child.uid, shape.last[child.uid] + 1))
        node = node.parent
    for catching in nodes:
        if (
            isinstance(catching, TryCatch)
            and catching.status is RUNNING
            and "catch_on_halt" in catching.ports
        ):
            last = catching.children[-1].uid  # a halt ticks it
            found.update(range(last, shape.last[last] + 1))
    return tuple(sorted(found))


def _children_ahead(parent: Node, position: int, *, is_halt: bool) -> Iterable[Node]:
    """Returns the children that a node may tick in this tick after the one at a position."""
    children = parent.children
    if is_halt and isinstance(parent, (Switch, *CHOOSING)):
        return children
    if isinstance(parent, ONCE):
        return ()
    if isinstance(parent, LATER):
        done = parent.done if isinstance(parent, (Parallel, ParallelAll)) else ()
        return [child for index, child in enumerate(children) if index > position and index not in done]
    if isinstance(parent, CHOOSING):
        return children[1:] if position == 0 else ()
    if isinstance(parent, TryCatch):
        return children[position + 1 :]
    return children  # a node that repeats its child, or a class of the user
