"""The five statuses."""

from __future__ import annotations

from py_trees.common import Status as PyTreesStatus

from tree_gardener.status import Status, to_py_trees


def test_each_has_a_letter_of_its_own() -> None:
    assert {status.letter for status in Status} == set("IRSFK")
    assert [status for status in Status if status.is_completed] == [Status.SUCCESS, Status.FAILURE]


def test_py_trees_has_four() -> None:
    assert to_py_trees(Status.SKIPPED) is to_py_trees(Status.IDLE) is PyTreesStatus.INVALID
    assert to_py_trees(Status.RUNNING) is PyTreesStatus.RUNNING
