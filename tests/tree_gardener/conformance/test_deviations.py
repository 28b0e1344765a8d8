"""Deliberate differences from BehaviorTree.CPP are recognised in a run."""

from __future__ import annotations

from tree_gardener.blackboard import Blackboard
from tree_gardener.conformance.deviations import DEVIATIONS, WatchedBlackboard


def test_a_remap_to_a_global_is_recorded() -> None:
    root = WatchedBlackboard()
    inner = WatchedBlackboard(root)
    inner.remapping["x"] = "@g"
    inner.create("y", None)
    assert root.deviations == set()
    inner.create("x", None)
    assert root.deviations == inner.deviations == set(DEVIATIONS)
    assert isinstance(inner, Blackboard)
