"""Forced results have the effect of the hooks of BehaviorTree.CPP's Groot2 publisher (4.8.2)."""

from __future__ import annotations

import pytest

from tests.budget import count
from tests.tree_gardener.debugging import hooked
from tests.tree_gardener.fuzz.compare import reference_traces
from tree_gardener.debugging.forces import Forces

BATCH = 100  # a publisher takes 0.15 s to close, and a batch has five minutes


@pytest.mark.timeout(1800)
def test_forced_results_are_those_of_behaviortree_cpp() -> None:
    total = count("debugger_hooks_trees")
    wanted = [hooked.forced(seed) for seed in range(1, total + 1)]
    compared = acted = 0
    references = [
        reference
        for start in range(0, total, BATCH)
        for reference in reference_traces(wanted[start : start + BATCH], hooked.__name__)
    ]
    for each, reference in zip(wanted, references, strict=True):
        if reference is None:
            continue
        assert hooked.ours(each) == reference, f"seed {each.case.seed}: {each.forces}\n{each.case.xml()}"
        compared += 1
        acted += hooked.ours(hooked.Forced(each.case, ())) != reference
    # Crashes, and forces at nodes that are never ticked, would prove nothing.
    assert compared >= 0.95 * total
    assert acted >= 0.3 * total


def test_a_difference_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = [hooked.forced(seed) for seed in range(1, 13)]
    references = reference_traces(wanted, hooked.__name__)
    monkeypatch.setattr(Forces, "before", lambda forces, node: None)
    assert any(hooked.ours(each) != reference for each, reference in zip(wanted, references, strict=True))
