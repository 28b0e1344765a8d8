"""RunOnce."""

from __future__ import annotations

from py_trees.common import Status

from tests.tree_gardener.trees import leaf, letters, load, recording
from tree_gardener.decorators.run_once import RunOnce

NAME = RunOnce.__name__


def test_the_child_runs_to_its_end_once() -> None:
    nodes = {"A": recording(Status.RUNNING, Status.FAILURE)}
    tree = load(f"<{NAME}><A name='a'/></{NAME}>", nodes=nodes)
    assert letters(tree, 4) == "RFKK"
    assert leaf(tree, "a").calls.count("update") == 2


def test_the_first_result_may_be_kept_over_halts() -> None:
    tree = load(f"<{NAME} then_skip='false'><Failing/></{NAME}>")
    assert letters(tree, 1) == "F"
    tree.halt()
    assert letters(tree, 2) == "FF"
