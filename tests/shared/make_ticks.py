"""Writes `ticks.json`: random trees that ran, what is recorded of each tick, and which nodes were ticked.

python -m tests.shared.make_ticks
"""

from __future__ import annotations

import json
import random
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import py_trees
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.fuzz.generate import KEYS, generate
from tests.tree_gardener.testing.random_trees import random_tree
from tree_gardener import Status, TickError, Tree
from tree_gardener.blackboard import Blackboard
from tree_gardener.clock import ManualClock
from tree_gardener.conditions import PRE_CONDITIONS
from tree_gardener.control_node import ControlNode, DecoratorNode
from tree_gardener.values import INT

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tree_gardener import TickChanges

FILE: Final = Path(__file__).with_name("ticks.json")
FUZZ_SEEDS: Final = 260
TIMED_SEEDS: Final = 90
TICKS: Final = 9
RESULTS: Final = {
    "S": PyTreesStatus.SUCCESS,
    "F": PyTreesStatus.FAILURE,
    "R": PyTreesStatus.RUNNING,
    "K": Status.SKIPPED,
}


class Turns(ControlNode):
    """An own control: it ticks its children in turn, and the last one of them twice."""

    turn = 0

    def update(self) -> Any:
        """Ticks one child."""
        self.turn = (self.turn + 1) % self.child_count
        result = self.tick_child(self.turn)
        if self.turn == self.child_count - 1 and result is not Status.RUNNING:
            self.halt_child(self.turn)
            result = self.tick_child(self.turn)
        if result is Status.RUNNING:
            return Status.RUNNING
        self.reset_children()
        return result


class Sometimes(DecoratorNode):
    """An own decorator: it ticks its child at every second tick."""

    count = 0

    def update(self) -> Any:
        """Ticks the child or not."""
        self.count += 1
        if self.count % 2 == 0 and self.child_status() is not Status.RUNNING:
            return Status.FAILURE
        return self.tick_child()


def leaf_classes(chance: random.Random) -> dict[str, type]:
    """The leaves of both generators; each has a result of its script, or a random one."""

    class Scripted(py_trees.behaviour.Behaviour):
        cursor = 0

        def update(self) -> Any:
            letters = self.name.rpartition(".")[2]
            if not re.fullmatch("[SFRK]+", letters):
                return RESULTS[chance.choice(self.LETTERS)]
            self.cursor += 1
            return RESULTS[letters[min(self.cursor, len(letters)) - 1]]

    class Leaf(Scripted):
        LETTERS = "SSFRRK"

    class Act(Leaf):
        INPUT_PORTS: Final = {"value": str}

    class SyncLeaf(Scripted):
        NODE_KIND = "SyncAction"
        LETTERS = "SF"

    class Cond(SyncLeaf):
        NODE_KIND = "Condition"

    class Check(Act):
        NODE_KIND = "Condition"
        LETTERS = "SF"

    kinds = (Leaf, SyncLeaf, Cond, Act, Check, Turns, Sometimes)
    return {cls.__name__: cls for cls in kinds}


def documents() -> Iterator[tuple[str, str, tuple[int, ...], tuple[tuple[int, str, int], ...]]]:
    """Name, XML, ticks before which the tree is halted, and writes of each case."""
    for seed in range(FUZZ_SEEDS):
        case = generate(seed)
        if case.mode == "exactly_once":
            xml = case.xml()
            if seed % 3 == 0:
                xml = xml.replace("<ForceSuccess", "<Sometimes").replace("</ForceSuccess", "</Sometimes")
                xml = xml.replace("<Fallback", "<Turns").replace("</Fallback", "</Turns")
            yield f"seed {seed}", xml, case.halts, case.writes
    for seed in range(TIMED_SEEDS):
        chance = random.Random(seed)  # noqa: S311 - a reproducible tree, no secret
        body = random_tree(chance)
        if seed % 2:
            body = body.replace("<TryCatch", '<TryCatch catch_on_halt="true"')
        head = '<root BTCPP_format="4" main_tree_to_execute="M"><BehaviorTree ID="M">'
        yield f"timed {seed}", f"{head}{body}</BehaviorTree></root>", (), ()


def run(
    what: str, xml: str, halts: tuple[int, ...], writes: tuple[tuple[int, str, int], ...]
) -> dict[str, Any] | None:
    """Returns the tree and its ticks; None if it cannot be loaded."""
    chance = random.Random(what)  # noqa: S311 - a reproducible run, no secret
    board = Blackboard()
    for key in KEYS:
        board.set(key, 1, INT)
    clock = ManualClock()
    tree = Tree.from_xml(xml, leaf_classes(chance), blackboard=board, clock=clock)
    log = tree.log_results()
    told: list[TickChanges] = []
    tree.observe(told.append)
    ticks: list[dict[str, Any]] = []

    def take(**more: Any) -> None:
        for changes in told:
            row = {"changed": coded(changes.changed), "flashed": coded(changes.flashed)}
            ticks.append({**row, **more, "ticked": coded(log)})
        told.clear()
        log.clear()

    for tick in range(TICKS):
        if tick in halts:
            tree.halt()
            take(halt=True)
        for when, key, value in writes:
            if when == tick:
                board.set(key, value, INT)
        clock.advance(0.06)
        try:
            tree.tick_exactly_once()
        except TickError:
            break
        take()
    nodes = [
        [node.uid, node.parent.uid if node.parent else 0, node.type, node.kind,
         [name for name in PRE_CONDITIONS if name in node.attributes]]
        for node in tree.nodes
    ]  # fmt: skip
    return {"what": what, "nodes": nodes, "ticks": ticks} if ticks else None


def coded(marks: list[tuple[int, Status]]) -> str:
    """Uids and letters of statuses, as in ``3S1R``."""
    return "".join(f"{uid}{status.letter}" for uid, status in marks)


def cases() -> list[dict[str, Any]]:
    """All cases that load and have more than one node."""
    found = [run(*each) for each in documents()]
    return [case for case in found if case and len(case["nodes"]) > 2]


def text() -> str:
    """The file: one line a case."""
    return "[\n" + ",\n".join(json.dumps(row, separators=(",", ":")) for row in cases()) + "\n]\n"


def main() -> None:
    """Writes the file."""
    FILE.write_text(text(), encoding="utf-8")


if __name__ == "__main__":
    main()
