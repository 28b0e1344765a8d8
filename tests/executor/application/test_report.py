"""Reports of the application about its tree."""

from __future__ import annotations

from typing import Any

import pytest

from executor import child_messages
from executor.application.locate import Place
from executor.application.report import SAME_FAULT_INTERVAL_S, Reporter, describe_tree
from tests.tree_gardener.trees import load
from tree_gardener import LoadError, Status, TickError, Tree
from tree_gardener.debugging import Force
from tree_gardener.debugging.debugger import Debugger


class Desk:
    """A reporter with a clock of its own."""

    def __init__(self) -> None:
        self.now_s = 0.0
        self.sent: list[Any] = []
        self.reporter = Reporter(self.sent.append, lambda: 1.5, clock=lambda: self.now_s)

    def of(self, kind: type) -> list[Any]:
        return [message for message in self.sent if isinstance(message, kind)]


def test_the_nodes_of_a_tree_are_in_preorder() -> None:
    tree = load("<Sequence><Succeeding/><Failing name='b'/></Sequence>")
    assert [(node.uid, node.parent, node.type) for node in describe_tree(tree)] == [
        *((1, 0, "Sequence"), (2, 1, "Succeeding"), (3, 1, "Failing"))
    ]


def test_ticks_and_written_entries_are_reported() -> None:
    desk = Desk()
    tree = load("<Sequence><Script code='a := 1'/><Running/></Sequence>")
    tree.observe(desk.reporter.ticked)
    tree.tick_exactly_once()
    [tick] = desk.of(child_messages.Tick)
    assert (tick.n, tick.t) == (1, 1.5)
    assert (1, "RUNNING") in tick.changed
    [board] = desk.of(child_messages.Blackboard)
    assert [(entry.key, entry.value) for entry in board.entries] == [("a", 1)]


def test_the_same_exception_is_reported_once_a_second() -> None:
    desk = Desk()
    with pytest.raises(TickError) as raised:
        load("<Raising/>").tick_exactly_once()
    for _ in range(3):
        desk.reporter.raised(raised.value)
    assert len(desk.of(child_messages.Fault)) == 1
    desk.now_s += SAME_FAULT_INTERVAL_S
    desk.reporter.raised(raised.value)
    assert len(desk.of(child_messages.Fault)) == 2


def test_what_cannot_be_loaded_is_reported_with_its_hint() -> None:
    desk = Desk()
    with pytest.raises(LoadError) as refused:
        Tree.from_xml("<root>")
    desk.reporter.not_loaded(refused.value, Place())
    [fault] = desk.of(child_messages.Fault)
    assert (fault.kind, bool(fault.hint)) == ("load", True)
    desk.reporter.not_loaded(SystemExit(3), Place())
    assert "sys.exit(3)" in desk.of(child_messages.Fault)[-1].message


def test_the_end_names_the_result() -> None:
    desk = Desk()
    desk.reporter.tree(load("<Succeeding/>"))
    desk.reporter.ended(Status.SUCCESS)
    [finished] = desk.of(child_messages.Finished)
    assert (finished.status, finished.reason) == ("SUCCESS", "root_finished")


def test_the_last_tick_stays_over_the_halt_and_the_end_names_the_node_that_failed() -> None:
    desk = Desk()
    tree = load("<Sequence><Succeeding/><Failing name='b'/></Sequence>")
    desk.reporter.tree(tree)
    tree.observe(desk.reporter.ticked)
    status = tree.tick_exactly_once()
    tree.halt()
    desk.reporter.ended(status)
    [tick, *_] = ticks = desk.of(child_messages.Tick)
    assert dict(tick.past) == {1: "FAILURE", 2: "SUCCESS", 3: "FAILURE"}
    assert (ticks[-1].n, ticks[-1].past) == (1, tick.past)
    [finished] = desk.of(child_messages.Finished)
    assert finished.node_path.endswith("b")


def test_a_tick_without_changes_that_clears_the_last_one_is_reported() -> None:
    desk = Desk()
    tree = load("<Sequence><Running/><Failing/></Sequence>")
    tree.observe(desk.reporter.ticked)
    for _ in range(2):
        tree.tick_exactly_once()
    tree.halt()
    assert desk.of(child_messages.Tick)[-1].past
    for _ in range(2):
        tree.tick_exactly_once()
    assert desk.of(child_messages.Tick)[-1].past == []


def test_a_tick_that_is_forced_is_reported_though_nothing_changes() -> None:
    desk = Desk()
    tree = load("<Sequence><Running/></Sequence>")
    debugger = Debugger(lambda _: None)
    tree.debug(debugger)
    tree.observe(desk.reporter.ticked)
    tree.tick_exactly_once()
    debugger.force(Force(2, Status.RUNNING))
    for _ in range(3):
        tree.tick_exactly_once()
    debugger.release()
    tree.tick_exactly_once()
    assert [(tick.n, tick.forced) for tick in desk.of(child_messages.Tick)] == [(1, []), (2, [2]), (5, [])]


def test_a_held_tick_reports_what_it_has_written_so_far() -> None:
    sent: list[Any] = []
    reporter = Reporter(sent.append, lambda: 0.0)
    tree = Tree.from_xml(
        "<root BTCPP_format='4'><BehaviorTree ID='M'><Script code='n := 1'/></BehaviorTree></root>"
    )
    tree.setup()
    tree.tick_exactly_once()
    reporter.held(tree)
    reporter.held(tree)
    [blackboard] = sent
    assert [(entry.key, entry.value) for entry in blackboard.entries] == [("n", 1)]


def test_a_hold_at_a_line_of_python_reports_the_tick_so_far() -> None:
    sent: list[Any] = []
    reporter = Reporter(sent.append, lambda: 0.0)
    tree = load("<Sequence><Succeeding/><Running/></Sequence>")
    tree.tick_exactly_once()
    reporter.held_in_python(tree, tree.nodes[2])
    held = sent[0]
    assert (held.uid, held.path, held.tick) == (3, [1, 3], 1)
    assert held.statuses == [(1, "RUNNING"), (2, "SUCCESS"), (3, "RUNNING")]
