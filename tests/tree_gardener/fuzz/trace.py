"""The trace of a case in either engine: one line a tick, then the final halt."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.fuzz.generate import KEYS, Case
from tree_gardener import Status, TickError, Tree
from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.ports import node_of
from tree_gardener.values import INT, ConversionError, parse_double

if TYPE_CHECKING:
    from collections.abc import Callable

Line = dict[str, Any]


@dataclasses.dataclass
class Script:
    """The letters of one leaf."""

    letters: str
    cursor: int = 0

    def next(self) -> str:
        letter = self.letters[min(self.cursor, len(self.letters) - 1)]
        self.cursor += 1
        return letter


class Scripts:
    """The scripts of all leaves by path, and the events that they leave."""

    def __init__(self) -> None:
        self.by_path: dict[str, Script] = {}
        self.events: list[str] = []

    def play(self, event: str, path: str) -> str:
        self.events.append(f"{event}:{path}")
        script = self.by_path.setdefault(path, Script(path.rpartition(".")[2]))
        return script.next()

    def take(self) -> list[str]:
        events, self.events = self.events, []
        return events


def run_reference(
    case: Case, prepare: Callable[[Any], Any] = id, look: Callable[[Any], object] | None = None
) -> list[Line]:
    """Runs a case in BehaviorTree.CPP; call it in a process that may crash.

    `prepare` is called with the tree, and what it returns is kept until the end of the run. `look` is called
    with that after each tick; what it returns is a part of the line.
    """
    import behaviortreepy as cpp

    results = {
        "S": cpp.NodeStatus.SUCCESS,
        "F": cpp.NodeStatus.FAILURE,
        "R": cpp.NodeStatus.RUNNING,
        "K": cpp.NodeStatus.SKIPPED,
    }
    scripts = Scripts()

    def play(event: str) -> Any:
        return lambda node: results[scripts.play(event, node.full_path())]

    def halted(node: Any) -> None:
        scripts.events.append(f"halt:{node.full_path()}")

    factory = cpp.BehaviorTreeFactory()
    factory.register_simple_stateful_action("Leaf", play("start"), play("tick"), halted)
    factory.register_simple_action("SyncLeaf", play("tick"))
    factory.register_simple_condition("Cond", play("tick"))
    board = cpp.Blackboard.create()
    for key in KEYS:
        board.set_int(key, 1)
    try:
        tree = factory.create_tree_from_text(case.xml(), board)
    except RuntimeError:
        return [{"load": "refused"}]
    kept = prepare(tree)
    lines: list[Line] = []
    for tick in range(case.ticks):
        if tick in case.halts:
            tree.halt_tree()
        for when, key, value in case.writes:
            if when == tick:
                board.set_int(key, value)
        try:
            root = tree.tick_once() if case.mode == "once" else tree.tick_exactly_once()
        except RuntimeError:
            lines.append({"root": "exception", "events": scripts.take()})
            return lines
        lines.append({"root": root.name, "events": scripts.take(), "board": _read_cpp(board)})
        if look is not None:
            lines[-1]["seen"] = look(kept)
    tree.halt_tree()
    lines.append({"root": "halt", "events": scripts.take(), "board": _read_cpp(board)})
    del kept
    return lines


def _read_cpp(board: Any) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key in board.get_keys():
        found[key] = None
        for read in (board.get_double, board.get_string):
            try:
                found[key] = read(key)
                break
            except RuntimeError:
                continue
    return found


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
