"""Delay and Timeout."""

from __future__ import annotations

from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener import ManualClock
from tree_gardener.decorators.timing import Delay, Timeout


def test_a_delay_waits_before_its_child() -> None:
    clock = ManualClock()
    tree = load(f"<{Delay.__name__} delay_msec='100'><Succeeding/></Delay>", clock=clock)
    assert letters(tree, 1) == "R"
    clock.advance(0.05)
    assert letters(tree, 1) == "R"
    clock.advance(0.05)
    assert letters(tree, 1) == "S"


def test_a_timeout_halts_its_child_and_fails() -> None:
    clock = ManualClock()
    nodes = {"A": recording(Status.RUNNING)}
    tree = load(f"<{Timeout.__name__} msec='100'><A name='a'/></Timeout>", clock=clock, nodes=nodes)
    assert letters(tree, 1) == "R"
    clock.advance(0.1)
    assert letters(tree, 1) == "F"
    assert leaf(tree, "a").calls[-1] == "terminate INVALID from RUNNING"


def test_no_limit_is_none() -> None:
    clock = ManualClock()
    tree = load("<Timeout msec='0'><Running/></Timeout>", clock=clock)
    assert letters(tree, 1) == "R"
    clock.advance(1000)
    assert letters(tree, 1) == "R"
