"""Forced results have the effect of the hooks of BehaviorTree.CPP's Groot2 publisher (4.8.2)."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import pytest

from tests.budget import count
from tests.tree_gardener.debugging import hooked
from tests.tree_gardener.fuzz.compare import reference_traces
from tree_gardener.debugging.forces import Forces

if TYPE_CHECKING:
    from tests.tree_gardener.fuzz.reference import Line

BATCH = 100  # a publisher takes 0.15 s to close, and a batch has five minutes


@functools.cache
def compared_cases() -> list[tuple[hooked.Forced, list[Line] | None]]:
    """Random trees with forced results, and their traces in BehaviorTree.CPP."""
    total = count("debugger_hooks_trees")
    wanted = [hooked.forced(seed) for seed in range(1, total + 1)]
    references = [
        reference
        for start in range(0, total, BATCH)
        for reference in reference_traces(wanted[start : start + BATCH], hooked.__name__)
    ]
    return list(zip(wanted, references, strict=True))


@pytest.mark.timeout(1800)
def test_forced_results_are_those_of_behaviortree_cpp() -> None:
    total = count("debugger_hooks_trees")
    compared = acted = 0
    for each, reference in compared_cases():
        if reference is None:
            continue
        assert hooked.ours(each) == reference, f"seed {each.case.seed}: {each.forces}\n{each.case.xml()}"
        compared += 1
        acted += hooked.ours(hooked.Forced(each.case, ())) != reference
    # Crashes, and forces at nodes that are never ticked, would prove nothing.
    assert compared >= 0.95 * total
    assert acted >= 0.3 * total


def test_a_difference_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    some = [(each, reference) for each, reference in compared_cases()[:12] if reference is not None]
    monkeypatch.setattr(Forces, "before", lambda forces, node: None)
    assert any(hooked.ours(each) != reference for each, reference in some)
