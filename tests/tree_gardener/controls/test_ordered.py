"""The rule that sequences and fallbacks share."""

from __future__ import annotations

import pytest
from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener.controls.fallback import Fallback
from tree_gardener.controls.ordered import Ordered, Yielding
from tree_gardener.controls.sequence import AsyncSequence, Sequence

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE


def test_a_running_child_is_resumed() -> None:
    tree = load("<Sequence><A name='a'/><B/></Sequence>", nodes={"A": recording(S), "B": recording(R, R, S)})
    assert letters(tree, 3) == "RRS"
    assert leaf(tree, "a").calls.count("update") == 1


@pytest.mark.parametrize("kind", ["Sequence", "Fallback"])
def test_skipped_children_are_passed_over(kind: str) -> None:
    skipped = "<Failing _skipIf='true'/>"
    assert letters(load(f"<{kind}>{skipped}{skipped}</{kind}>"), 1) == "K"
    assert letters(load(f"<{kind}>{skipped}<Succeeding/></{kind}>"), 1) == "S"


def test_both_share_the_rule_with_the_statuses_exchanged() -> None:
    assert issubclass(Sequence, Ordered)
    assert issubclass(AsyncSequence, Yielding)
    assert (Fallback.GOES_ON, Fallback.ENDS) == (Sequence.ENDS, Sequence.GOES_ON)
