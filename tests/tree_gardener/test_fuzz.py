"""The same random trees in the engine and in BehaviorTree.CPP 4.8.2."""

from __future__ import annotations

import functools
import os
from typing import TYPE_CHECKING

import pytest

from tests.budget import count
from tests.tree_gardener.fuzz.compare import difference, reference_traces, report, shrink
from tests.tree_gardener.fuzz.generate import generate, make
from tree_gardener.decorators.result import ForceSuccess, Inverter
from tree_gardener.generated import generation

if TYPE_CHECKING:
    from tests.tree_gardener.fuzz.generate import Case
    from tests.tree_gardener.fuzz.reference import Line

BATCH = 400
FIRST_SEED = int(os.environ.get("BT_STUDIO_FUZZ_SEED", "1"))
KEPT = 16


@functools.lru_cache(KEPT)
def batch(start: int, end: int) -> list[tuple[Case, list[Line] | None]]:
    """Random trees with their traces in BehaviorTree.CPP."""
    cases = [generate(seed) for seed in range(start, end)]
    return list(zip(cases, reference_traces(cases), strict=True))


@pytest.mark.timeout(7200)
def test_random_trees_run_as_in_behaviortree_cpp(monkeypatch: pytest.MonkeyPatch) -> None:
    total, compared, refused = count("engine_fuzz_trees"), 0, 0
    for start in range(FIRST_SEED, FIRST_SEED + total, BATCH):
        for case, reference in batch(start, min(start + BATCH, FIRST_SEED + total)):
            for is_generated in (True, False):
                monkeypatch.setattr(generation, "ENABLED", is_generated)
                if difference(case, reference):
                    pytest.fail(report(case))
            compared += reference is not None
            refused += reference == [{"load": "refused"}]
    # A generator that makes only refused trees or crashes would prove nothing.
    assert compared >= 0.97 * total
    assert refused <= 0.05 * total


def test_a_broken_rule_is_found_and_shrunk(monkeypatch: pytest.MonkeyPatch) -> None:
    found = [each for each in batch(FIRST_SEED, FIRST_SEED + BATCH)[:100] if each[0].mode == "exactly_once"]
    monkeypatch.setattr(Inverter, "go_on", ForceSuccess.go_on)
    broken = [case for case, reference in found if difference(case, reference)]
    assert broken
    assert shrink(min(broken, key=lambda case: case.size)).size <= 4


def test_the_generator_makes_the_same_case_of_the_same_seed() -> None:
    seed = 271_828
    assert make(seed) == make(seed)
    assert make(seed).xml() != make(seed + 1).xml()
