"""Repeat and RetryUntilSuccessful."""

from __future__ import annotations

import pytest
from py_trees.common import Status

from tests.tree_gardener.trees import letters, load, recording
from tree_gardener.decorators.repeat import Repeat, RetryUntilSuccessful

R, S, F = Status.RUNNING, Status.SUCCESS, Status.FAILURE


@pytest.mark.parametrize(
    ("xml", "results"),
    [
        ("<Repeat num_cycles='3'><A/></Repeat>", "RRS"),
        ("<Repeat num_cycles='0'><A/></Repeat>", "S"),
        ("<Repeat num_cycles='-1'><A/></Repeat>", "RRRR"),
        ("<Repeat num_cycles='3'><B/></Repeat>", "F"),
        ("<RetryUntilSuccessful num_attempts='2'><B/></RetryUntilSuccessful>", "RF"),
        ("<RetryUntilSuccessful num_attempts='3'><C/></RetryUntilSuccessful>", "RS"),
        ("<RetryUntilSuccessful num_attempts='0'><A/></RetryUntilSuccessful>", "F"),
    ],
)
def test_a_child_is_ticked_again_so_often(xml: str, results: str) -> None:
    nodes = {"A": recording(S), "B": recording(F), "C": recording(F, S)}
    assert letters(load(xml, nodes=nodes), len(results)) == results


def test_a_halt_forgets_the_count() -> None:
    for kind, child in ((Repeat, "Succeeding"), (RetryUntilSuccessful, "Failing")):
        ports = "num_cycles" if kind is Repeat else "num_attempts"
        tree = load(f"<{kind.__name__} {ports}='2'><{child}/></{kind.__name__}>")
        assert letters(tree, 1) == "R"
        tree.halt()
        assert letters(tree, 1) == "R"
