"""The trace of a case in BehaviorTree.CPP: one line a tick, then the final halt.

Our engine is not loaded here: a process that runs the reference starts in a third of the time without it.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING, Any

from tests.tree_gardener.fuzz.generate import KEYS

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.tree_gardener.fuzz.generate import Case

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
