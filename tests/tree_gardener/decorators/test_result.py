"""Decorators that change the result of their child."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.trees import letters, load
from tree_gardener.decorators.result import ForceFailure, ForceSuccess, Inverter, KeepRunningUntilFailure

if TYPE_CHECKING:
    from tree_gardener.node import Decorator


@pytest.mark.parametrize(
    ("kind", "results"),
    [
        (Inverter, {"Succeeding": "F", "Failing": "S", "Running": "R"}),
        (ForceSuccess, {"Succeeding": "S", "Failing": "S", "Running": "R"}),
        (ForceFailure, {"Succeeding": "F", "Failing": "F", "Running": "R"}),
        (KeepRunningUntilFailure, {"Succeeding": "R", "Failing": "F", "Running": "R"}),
    ],
)
def test_each_result_becomes_another(kind: type[Decorator], results: dict[str, str]) -> None:
    name = kind.__name__
    assert {child: letters(load(f"<{name}><{child}/></{name}>"), 1) for child in results} == results


@pytest.mark.parametrize("kind", [Inverter, ForceSuccess, ForceFailure])
def test_a_skipped_child_makes_it_skipped(kind: type[Decorator]) -> None:
    assert letters(load(f"<{kind.__name__}><Failing _skipIf='true'/></{kind.__name__}>"), 1) == "K"
