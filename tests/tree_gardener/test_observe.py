"""Observers receive exactly the changes that happened."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import py_trees
import pytest
from py_trees.common import Status as PyTreesStatus

from tests.tree_gardener.fuzz.generate import KEYS, Case, generate
from tests.tree_gardener.trees import Failing, Raising, Running, Succeeding, document, load
from tree_gardener import BlackboardChange, Status, TickChanges, TickError, Tree
from tree_gardener.blackboard import EMPTY, Blackboard
from tree_gardener.values import INT

if TYPE_CHECKING:
    from tree_gardener.node import Node

RESULTS: dict[str, Any] = {
    "S": PyTreesStatus.SUCCESS,
    "F": PyTreesStatus.FAILURE,
    "R": PyTreesStatus.RUNNING,
    "K": Status.SKIPPED,
}


class Lettered(py_trees.behaviour.Behaviour):
    cursor = 0

    def update(self) -> Any:
        letters = self.name.rpartition(".")[2]
        self.cursor += 1
        return RESULTS[letters[min(self.cursor, len(letters)) - 1]]


class Immediate(Lettered):
    NODE_KIND = "SyncAction"


class Asked(Lettered):
    NODE_KIND = "Condition"


def tree_of(case: Case) -> Tree:
    board = Blackboard()
    for key in KEYS:
        board.set(key, 1, INT)
    nodes = {"Leaf": Lettered, "SyncLeaf": Immediate, "Cond": Asked}
    return Tree.from_xml(case.xml(), nodes, blackboard=board)


@pytest.mark.parametrize("first", range(1, 201, 40))
def test_the_changes_add_up_to_the_statuses_and_the_blackboard(first: int) -> None:
    for seed in range(first, first + 40):
        case = generate(seed)
        tree = tree_of(case)
        statuses = {node.uid: Status.IDLE for node in tree.nodes}
        entries: dict[tuple[str, str], Any] = {}
        told: list[TickChanges] = []
        tree.observe(told.append)
        for tick in range(case.ticks):
            if tick in case.halts:
                tree.halt()
            try:
                tree.tick_once() if case.mode == "once" else tree.tick_exactly_once()
            except TickError:
                break
            finally:
                for changes in told:
                    statuses.update(changes.changed)
                    for change in changes.blackboard:
                        entries[change.scope, change.key] = None if change.removed else change.value
                told.clear()
                assert statuses == {node.uid: node.status for node in tree.nodes}, f"seed {seed}, tick {tick}"
                assert entries == {**dict.fromkeys(entries), **snapshot(tree)}, f"seed {seed}, tick {tick}"


def snapshot(tree: Tree) -> dict[tuple[str, str], Any]:
    return {
        (board.path, key): None if entry.value is EMPTY else entry.value
        for board in tree.boards
        for key, entry in board.entries.items()
    }


@pytest.mark.parametrize("first", [50, 175, *range(30_000, 30_100, 25)])
def test_a_node_that_returned_what_it_is_not_any_more_has_flashed(first: int) -> None:
    for seed in range(first, first + 25):
        case = generate(seed)
        observed, hooked = tree_of(case), tree_of(case)
        told: list[TickChanges] = []
        observed.observe(told.append)
        returned: list[tuple[int, Status]] = []

        def record(node: Node, status: Status, returned: list[tuple[int, Status]] = returned) -> None:
            returned.append((node.uid, status))

        hooked.add_hook(after=record)
        for tick in range(case.ticks):
            returned.clear()
            told.clear()
            try:
                observed.tick_exactly_once()
            except TickError:
                with pytest.raises(TickError):
                    hooked.tick_exactly_once()
                break
            hooked.tick_exactly_once()
            final = {node.uid: node.status for node in hooked.nodes}
            last = dict(returned)
            expected = {
                (uid, status)
                for uid, status in last.items()
                if status is not Status.RUNNING and status is not final[uid]
            }
            flashed = set(told[0].flashed)
            assert expected <= flashed, f"seed {seed}, tick {tick}"
            assert flashed <= set(returned), f"seed {seed}, tick {tick}"


def test_the_first_report_has_all_that_is_not_idle_and_all_entries() -> None:
    tree = load("<Sequence><Succeeding/><Running/></Sequence>")
    tree.blackboard["speed"] = 0.3
    tree.tick_once()
    told: list[TickChanges] = []
    tree.observe(told.append)
    tree.tick_once()
    assert told[0].changed == [(1, Status.RUNNING), (2, Status.SUCCESS), (3, Status.RUNNING)]
    assert [(change.key, change.value) for change in told[0].blackboard] == [("speed", 0.3)]


def test_a_tick_without_changes_is_reported_empty() -> None:
    tree = load("<Sequence><Succeeding/><Running/></Sequence>")
    told: list[TickChanges] = []
    tree.observe(told.append)
    tree.tick_once()
    tree.tick_once()
    assert (told[1].tick, told[1].changed, told[1].flashed, told[1].blackboard) == (2, [], [], [])
    assert told[1].duration_s > 0


def test_it_says_who_wrote() -> None:
    tree = load("<Sequence><Succeeding/><Script code=\"x := 'hi'\"/></Sequence>")
    told: list[TickChanges] = []
    tree.observe(told.append)
    tree.tick_once()
    assert told[0].blackboard == [BlackboardChange("", "x", "string", "hi", removed=False, writer_uid=3)]
    tree.blackboard.unset("x")
    tree.tick_once()
    assert [(change.removed, change.writer_uid) for change in told[1].blackboard[:1]] in (
        [(True, 0)],
        [(False, 3)],
    )


def test_unsubscribing_ends_the_reports_and_the_recording() -> None:
    tree = load("<Sequence><Succeeding/><Failing/></Sequence>")
    told: list[TickChanges] = []
    unsubscribe = tree.observe(told.append)
    tree.tick_once()
    unsubscribe()
    unsubscribe()
    tree.tick_once()
    assert len(told) == 1
    assert all(node.journal is None for node in tree.nodes)
    assert all(board.journal is None for board in tree.boards)


def test_a_tick_that_raises_is_reported_too() -> None:
    tree = load("<Sequence><Succeeding/><Raising/></Sequence>")
    told: list[TickChanges] = []
    tree.observe(told.append)
    with pytest.raises(TickError):
        tree.tick_once()
    assert told[0].changed == [(1, Status.RUNNING), (2, Status.SUCCESS)]


def test_node_times_are_measured_when_asked_for() -> None:
    tree = load("<Sequence><Succeeding/><Failing/></Sequence>")
    told: list[TickChanges] = []
    unsubscribe = tree.observe(told.append, node_times=True)
    tree.tick_once()
    assert sorted(told[0].node_times_s) == [1, 2, 3]
    assert told[0].node_times_s[1] >= told[0].node_times_s[2]
    unsubscribe()
    assert tree.node_times_s is None


def test_halting_is_reported() -> None:
    tree = load("<Sequence><Succeeding/><Running/></Sequence>")
    told: list[TickChanges] = []
    tree.observe(told.append)
    tree.tick_once()
    tree.halt()
    assert set(told[1].changed) == {(1, Status.IDLE), (2, Status.IDLE), (3, Status.IDLE)}


def test_the_leaves_used_here_are_found() -> None:
    nodes = {cls.__name__: cls for cls in (Succeeding, Failing, Running, Raising)}
    assert Tree.from_xml(document("<Succeeding/>"), nodes).tick_once() is Status.SUCCESS
