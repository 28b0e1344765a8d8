"""The memory of each kind of node between two ticks, beside its status.

Everything else in a node's slots is made when the tree is built or linked, or lives for one tick only.
"""

import collections
import enum
from collections.abc import Mapping, Sequence
from typing import Any, Final

from tree_gardener.clock import Timer
from tree_gardener.controls.if_then_else import IfThenElse
from tree_gardener.controls.ordered import Ordered
from tree_gardener.controls.parallel import Parallel, ParallelAll
from tree_gardener.controls.switch import Switch
from tree_gardener.controls.try_catch import TryCatch
from tree_gardener.decorators.loop import Loop
from tree_gardener.decorators.precondition import Precondition
from tree_gardener.decorators.repeat import Repeat, RetryUntilSuccessful
from tree_gardener.decorators.run_once import RunOnce
from tree_gardener.decorators.timing import Delay, Timeout
from tree_gardener.decorators.update import SkipUnlessUpdated, WaitValueUpdate
from tree_gardener.leaves.entries import WasEntryUpdated
from tree_gardener.leaves.sleep import Sleep
from tree_gardener.leaves.test_node import TestNode
from tree_gardener.node import Node
from tree_gardener.status import FAILURE, RUNNING, SUCCESS
from tree_gardener.swap.state import Due, Key, NodeState


class Part(enum.Enum):
    """A kind of memory."""

    VALUE = "a count, a latch or a result"
    CHILD = "the index of the current child"
    DONE = "the indices of the children that are done; their results are counted beside it"
    SKIPS = "the number of skipped children before the current one"
    TIMER = "a timer"
    QUEUE = "the elements that are left; shared where it is an entry of the blackboard"
    SEEN = "the sequence number of the entry that the node saw last"


_UPDATED: Final = {"busy": Part.VALUE, "seen": Part.SEEN}
_TIMED: Final = {"is_over": Part.VALUE, "timer": Part.TIMER}
_PARALLEL: Final = {"done": Part.DONE}
_COUNT: Final = {"count": Part.VALUE}

MEMORY: Final[Mapping[type[Node], Mapping[str, Part]]] = {
    Ordered: {"index": Part.CHILD, "skips": Part.SKIPS},
    Parallel: _PARALLEL,
    ParallelAll: _PARALLEL,
    IfThenElse: {"chosen": Part.CHILD},
    Switch: {"running": Part.CHILD},
    TryCatch: {"index": Part.CHILD, "skips": Part.SKIPS, "catching": Part.VALUE},
    Repeat: _COUNT,
    RetryUntilSuccessful: _COUNT,
    RunOnce: {"result": Part.VALUE},
    Precondition: {"open": Part.VALUE},
    Loop: {"busy": Part.VALUE, "queue": Part.QUEUE},
    SkipUnlessUpdated: _UPDATED,
    WaitValueUpdate: _UPDATED,
    Delay: _TIMED,
    Timeout: {"started": Part.VALUE, "expired": Part.VALUE, "timer": Part.TIMER},
    WasEntryUpdated: {"seen": Part.SEEN},
    Sleep: _TIMED,
    TestNode: _TIMED,
}


def parts_of(node: Node) -> Mapping[str, Part]:
    """Returns the parts of a node's memory, by attribute."""
    for cls in type(node).__mro__:
        if cls in MEMORY:
            return MEMORY[cls]
    return {}


def taken(node: Node, children: Sequence[Key], orders: Mapping[int, int]) -> dict[str, Any]:
    """Returns the memory of a node as data.

    Args:
        node: the node.
        children: the keys of its children.
        orders: the places of the timers that have not fired, by the `id` of the timer.
    """
    memory: dict[str, Any] = {}
    for name, part in parts_of(node).items():
        held = getattr(node, name)
        match part:
            case Part.CHILD:
                memory[name] = _current(node, held, children)
            case Part.DONE:
                memory[name] = frozenset(children[index] for index in held)
            case Part.SKIPS:
                memory[name] = (held, tuple(children[: node.index]))  # type: ignore[attr-defined]
            case Part.TIMER:
                memory[name] = None if held is None else Due(held.deadline_s, orders.get(id(held)))
            case Part.SEEN:
                memory[name] = (held, node.key)  # type: ignore[attr-defined]
            case Part.VALUE | Part.QUEUE:
                memory[name] = held
    return memory


def _current(node: Node, index: int, children: Sequence[Key]) -> Key | None:
    """Returns the key of the current child. The first one is where a node begins, and then not current."""
    if not 0 <= index < len(children):
        return None
    return children[index] if index > 0 or node.children[0].status is RUNNING else None


def current_child(state: NodeState) -> Key | None:
    """Returns the key of the child at which a node continues, or None."""
    for name in ("index", "chosen", "running"):
        key = state.memory.get(name)
        if key is not None:
            return key  # type: ignore[no-any-return]
    return None


def give(node: Node, state: NodeState, children: Sequence[Key]) -> list[tuple[Due, str]]:
    """Gives a node its memory; returns its timers that have not fired, with the attribute of each.

    Children are found by key; those that left are forgotten. `children` are the keys of the node's children.
    """
    places = {key: index for index, key in enumerate(children)}
    due: list[tuple[Due, str]] = []
    for name, part in parts_of(node).items():
        if name not in state.memory:
            continue
        held = state.memory[name]
        match part:
            case Part.CHILD:
                if held in places:
                    setattr(node, name, places[held])
            case Part.DONE:
                node.done = {places[key] for key in held if key in places}  # type: ignore[attr-defined]
            case Part.SKIPS:
                before = children[: node.index]  # type: ignore[attr-defined]
                setattr(node, name, _skips(held[0], held[1], before))
            case Part.TIMER:
                if held is not None and held.order is not None:
                    due.append((held, name))
                elif held is not None:
                    setattr(node, name, Timer(held.at_s, node.fire))  # type: ignore[attr-defined]
            case Part.SEEN:
                if held[1] == node.key:  # type: ignore[attr-defined]
                    setattr(node, name, held[0])
            case Part.QUEUE:
                setattr(node, name, held if isinstance(held, collections.deque) else collections.deque(held))
            case Part.VALUE:
                setattr(node, name, held)
    return due


def count_done(node: Node) -> None:
    """Counts the results of a Parallel's children that are done again, after their statuses were set."""
    if isinstance(node, (Parallel, ParallelAll)):
        results = [node.children[index].status for index in node.done]
        node.failures = results.count(FAILURE)
        if isinstance(node, Parallel):
            node.successes = results.count(SUCCESS)


def _skips(skips: int, before: Sequence[Key], now: Sequence[Key]) -> int:
    """Returns the count of skipped children after the children before the current one changed.

    The count only decides whether all children were skipped: this stays as it was.
    """
    if set(before) == set(now):
        return skips
    return len(now) if skips == len(before) else min(skips, max(len(now) - 1, 0))
