"""RecoveryNode as a project's own control node."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_trees import nav2_tree, ticks
from tree_gardener import LoadError
from tree_gardener.nav2.recovery_node import RecoveryNode


def test_it_recovers_as_often_as_it_may() -> None:
    assert ticks(nav2_tree(RecoveryNode, ["FFS", "S"], 'number_of_retries="2"'), 1) == "S"
    assert ticks(nav2_tree(RecoveryNode, ["FFS", "S"], 'number_of_retries="1"'), 1) == "F"


@pytest.mark.parametrize("count", [1, 3])
def test_it_has_two_children(count: int) -> None:
    with pytest.raises(LoadError, match="RecoveryNode has"):
        nav2_tree(RecoveryNode, ["S"] * count)
