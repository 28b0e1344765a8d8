"""ReactiveSequence and ReactiveFallback."""

from __future__ import annotations

from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener.controls.reactive import ReactiveFallback, ReactiveSequence

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE


def test_the_first_child_is_ticked_again_and_may_interrupt() -> None:
    tree = load(
        "<ReactiveSequence><A name='a'/><B name='b'/></ReactiveSequence>",
        nodes={"A": recording(S, S, F), "B": recording(R)},
    )
    assert letters(tree, 3) == "RRF"
    assert leaf(tree, "a").calls.count("update") == 3
    assert leaf(tree, "b").calls[-1] == "terminate INVALID from RUNNING"


def test_a_fallback_does_the_same_with_the_statuses_exchanged() -> None:
    nodes = {"A": recording(F, S), "B": recording(R)}
    assert letters(load("<ReactiveFallback><A/><B/></ReactiveFallback>", nodes=nodes), 2) == "RS"
    assert (ReactiveFallback.GOES_ON, ReactiveFallback.ENDS) == (
        ReactiveSequence.ENDS,
        ReactiveSequence.GOES_ON,
    )
