"""Sequence, AsyncSequence and SequenceWithMemory."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener.controls.sequence import AsyncSequence, Sequence, SequenceWithMemory

if TYPE_CHECKING:
    from tree_gardener.node import Control

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE


@pytest.mark.parametrize(
    ("kind", "results", "first_updates"),
    [(Sequence, "FFS", 3), (AsyncSequence, "RFRFRS", 3), (SequenceWithMemory, "RFFS", 1)],
)
def test_after_a_failure_it_starts_again_where_its_rule_says(
    kind: type[Control], results: str, first_updates: int
) -> None:
    xml = f"<{kind.__name__}><A name='a'/><B name='b'/></{kind.__name__}>"
    tree = load(xml, nodes={"A": recording(S), "B": recording(F, F, S)})
    assert letters(tree, len(results)) == results
    assert leaf(tree, "a").calls.count("update") == first_updates
