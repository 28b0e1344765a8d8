"""Reads the activity of a node, the time, and ports that may be missing, as all nodes of Nav2 do."""

from typing import Any

from tree_gardener.blackboard import EMPTY
from tree_gardener.errors import PortError
from tree_gardener.ports import get_input, node_of, set_output
from tree_gardener.status import Status


def is_active(node: Any) -> bool:
    """Returns whether a node was ticked since its parent reset it: its stored status is not IDLE."""
    return node_of(node).status is not Status.IDLE


def now(node: Any) -> float:
    """Returns seconds of the tree's clock."""
    return node_of(node).tree.clock.now()


def input_or(node: Any, port: str, otherwise: Any) -> Any:
    """Reads a port; returns `otherwise` if it cannot be read, as Nav2's nodes keep the last value."""
    try:
        return get_input(node, port)
    except PortError:
        return otherwise


def input_or_entry(node: Any, port: str, otherwise: Any = None) -> Any:
    """Reads a port, or else the blackboard entry with its name: ``getInputOrBlackboard`` in bt_utils.hpp."""
    try:
        return get_input(node, port)
    except PortError:
        entry = node_of(node).board.find(port)
        return otherwise if entry is None or entry.value is EMPTY else entry.value


def goals_of(node: Any, last: tuple[Any, Any] = (None, None)) -> tuple[Any, Any]:
    """Returns the goal and the goals; without a port and an entry, those of `last`."""
    return input_or_entry(node, "goal", last[0]), input_or_entry(node, "goals", last[1])


def give(node: Any, port: str, value: Any) -> None:
    """Writes an output port, if it leads to an entry; otherwise does nothing, as Nav2 does."""
    if port in node_of(node).ports:
        set_output(node, port, value)
