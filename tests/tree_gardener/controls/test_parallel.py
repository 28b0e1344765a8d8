"""Parallel and ParallelAll."""

from __future__ import annotations

import pytest
from py_trees.common import Status

from tests.tree_gardener.trees import letters, load, recording
from tree_gardener import TickError
from tree_gardener.controls.parallel import Parallel, ParallelAll

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE
NODES = {"Late": recording(R, S), "Bad": recording(F), "Good": recording(S)}


@pytest.mark.parametrize(
    ("attributes", "children", "results"),
    [
        ("success_count='1'", "<Late/><Good/>", "S"),
        ("success_count='2'", "<Late/><Good/>", "RS"),
        ("success_count='-1'", "<Late/><Bad/>", "F"),
        ("success_count='1' failure_count='2'", "<Bad/><Late/>", "RS"),
    ],
)
def test_it_ends_when_enough_are_done(attributes: str, children: str, results: str) -> None:
    assert (
        letters(load(f"<Parallel {attributes}>{children}</Parallel>", nodes=NODES), len(results)) == results
    )


def test_a_threshold_beyond_the_children_is_an_error() -> None:
    with pytest.raises(TickError, match="success_count is 3, but there are only 1 children"):
        load(f"<{Parallel.__name__} success_count='3'><Good/></Parallel>", nodes=NODES).tick_exactly_once()


def test_all_are_waited_for() -> None:
    name = ParallelAll.__name__
    assert letters(load(f"<{name}><Bad/><Late/></{name}>", nodes=NODES), 2) == "RF"
    assert letters(load(f"<{name} max_failures='2'><Bad/><Late/></{name}>", nodes=NODES), 2) == "RS"
