"""The leaves of the conformance cases record each callback."""

from __future__ import annotations

from tests.tree_gardener.trees import load
from tree_gardener.conformance.leaves import Trace, leaves


def test_a_leaf_follows_its_script_and_records() -> None:
    trace = Trace()
    tree = load("<Leaf name='a' script='RS'/>", nodes=leaves(trace))
    tree.tick_exactly_once()
    assert trace.take() == ["start:a"]
    tree.tick_exactly_once()
    assert trace.take() == ["tick:a"]
    assert trace.take() == []


def test_a_halt_is_recorded() -> None:
    trace = Trace()
    tree = load("<Leaf name='a' script='R'/>", nodes=leaves(trace))
    tree.tick_exactly_once()
    tree.halt()
    assert trace.take()[-1] == "halt:a"
