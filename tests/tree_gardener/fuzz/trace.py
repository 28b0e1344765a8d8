"""The trace of a case in our engine, in the form of the reference."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.fuzz.generate import KEYS, Case
from tests.tree_gardener.fuzz.reference import Line, Scripts
from tree_gardener import Status, TickError, Tree
from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.ports import node_of
from tree_gardener.values import INT, ConversionError, parse_double

if TYPE_CHECKING:
    from collections.abc import Callable


def run_ours(  # noqa: C901 - the loop is that of run_reference
    case: Case, prepare: Callable[[Tree], Any] = id, look: Callable[[Any], object] | None = None
) -> list[Line]:
    """Runs a case in our engine; `prepare` and `look` are as in `run_reference`."""
    scripts = Scripts()
    results = {
        "S": PyTreesStatus.SUCCESS,
        "F": PyTreesStatus.FAILURE,
        "R": PyTreesStatus.RUNNING,
        "K": Status.SKIPPED,
    }

    class Leaf(py_trees.behaviour.Behaviour):
        event = ""

        def initialise(self) -> None:
            self.event = "start"

        def update(self) -> Any:
            event, self.event = self.event or "tick", ""
            return results[scripts.play(event, node_of(self).path)]

        def terminate(self, new_status: PyTreesStatus) -> None:
            if new_status is PyTreesStatus.INVALID:
                scripts.events.append(f"halt:{node_of(self).path}")

    class SyncLeaf(py_trees.behaviour.Behaviour):
        NODE_KIND = "SyncAction"

        def update(self) -> Any:
            return results[scripts.play("tick", node_of(self).path)]

    class Cond(SyncLeaf):
        NODE_KIND = "Condition"

    board = Blackboard()
    for key in KEYS:
        board.set(key, 1, INT)
    nodes = {"Leaf": Leaf, "SyncLeaf": SyncLeaf, "Cond": Cond}
    tree = Tree.from_xml(case.xml(), nodes, blackboard=board)
    kept = prepare(tree)
    lines: list[Line] = []
    for tick in range(case.ticks):
        if tick in case.halts:
            tree.halt()
        for when, key, value in case.writes:
            if when == tick:
                board.set(key, value, INT)
        try:
            root = tree.tick_once() if case.mode == "once" else tree.tick_exactly_once()
        except TickError:
            lines.append({"root": "exception", "events": scripts.take()})
            return lines
        lines.append({"root": root.name, "events": scripts.take(), "board": _read(board)})
        if look is not None:
            lines[-1]["seen"] = look(kept)
    tree.halt()
    lines.append({"root": "halt", "events": scripts.take(), "board": _read(board)})
    return lines


def _read(board: Blackboard) -> dict[str, Any]:
    return {
        key: None if entry.value is EMPTY else _plain(entry.value) for key, entry in board.entries.items()
    }


def _plain(value: Any) -> Any:
    """As `get_double` of behaviortreepy reads it: a text that is a number is a number."""
    try:
        return parse_double(value) if isinstance(value, str) else float(value)
    except ConversionError:
        return value
