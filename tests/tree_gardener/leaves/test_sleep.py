"""Sleep."""

from __future__ import annotations

from tests.tree_gardener.trees import letters, load
from tree_gardener import ManualClock
from tree_gardener.leaves.sleep import Sleep


def test_it_runs_until_its_time_is_over() -> None:
    clock = ManualClock()
    tree = load(f"<{Sleep.__name__} msec='100'/>", clock=clock)
    assert letters(tree, 1) == "R"
    clock.advance(0.1)
    assert letters(tree, 1) == "S"


def test_a_halt_cancels_it() -> None:
    clock = ManualClock()
    tree = load("<Sleep msec='100'/>", clock=clock)
    assert letters(tree, 1) == "R"
    tree.halt()
    clock.advance(0.09)
    assert letters(tree, 1) == "R"
    clock.advance(0.09)
    assert letters(tree, 1) == "R"


def test_no_time_succeeds_at_once() -> None:
    assert letters(load("<Sleep msec='0'/>"), 1) == "S"
