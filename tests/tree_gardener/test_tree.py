"""Tick functions, hooks, timers, several documents, depth."""

from __future__ import annotations

import sys
import time
from typing import Any

import pytest
from py_trees.common import Status as PyTreesStatus

from tests.budget import count
from tests.tree_gardener.trees import LEAVES, load, subtree
from tree_gardener import ManualClock, Status, TickError, Tree

R, S, F = PyTreesStatus.RUNNING, PyTreesStatus.SUCCESS, PyTreesStatus.FAILURE


def test_tick_while_running_sleeps_by_the_clock_and_wakes_for_timers() -> None:
    clock = ManualClock()
    tree = load('<Delay delay_msec="250"><Succeeding/></Delay>', clock=clock)
    assert tree.tick_while_running(1000) is Status.SUCCESS
    assert clock.now() == pytest.approx(0.25)


def test_tick_while_running_with_the_computers_clock() -> None:
    tree = load('<Sleep msec="20"/>')
    start = time.monotonic()
    assert tree.tick_while_running(5) is Status.SUCCESS
    assert time.monotonic() - start >= 0.019


def test_wake_ends_a_sleep() -> None:
    tree = load("<Running/>", clock=ManualClock())
    tree.wake()
    tree.sleep(3600)
    assert tree.clock.now() == 0.0


def deep_document(depth: int, inner: str) -> str:
    trees = "".join(subtree(f"T{n}", f'<SubTree ID="T{n + 1}"/>') for n in range(depth))
    return f'<root main_tree_to_execute="T0">{trees}{subtree(f"T{depth}", inner)}</root>'


def test_thousands_of_levels_of_subtrees_run_observe_hook_and_halt() -> None:
    levels = count("engine_levels")
    assert levels > 2 * sys.getrecursionlimit()
    before = sys.getrecursionlimit()
    tree = Tree.from_xml(deep_document(levels, "<Running/>"), LEAVES)
    assert tree.depth == levels + 1
    assert tree.tick_exactly_once() is Status.RUNNING
    changes: list[Any] = []
    tree.observe(changes.append)
    tree.add_hook(before=lambda node: None)
    assert tree.tick_once() is Status.RUNNING
    assert len(changes[0].changed) == levels + 1
    tree.halt()
    assert all(node.status is Status.IDLE for node in tree.nodes)
    assert sys.getrecursionlimit() == before


def test_an_error_deep_down_is_a_tick_error_as_any() -> None:
    tree = Tree.from_xml(deep_document(1_500, "<Raising/>"), LEAVES)
    with pytest.raises(TickError, match="out of order"):
        tree.tick_once()
