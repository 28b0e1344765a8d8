"""RateController as a project's own decorator."""

from __future__ import annotations

import pytest

from tests.tree_gardener.nav2_trees import nav2_tree, ticks
from tree_gardener import ManualClock
from tree_gardener.nav2.rate_controller import RateController


@pytest.mark.parametrize(("hz", "expected"), [("2.0", "SRRSR"), ("0", "SRRRR"), ("-1", "SSSSS")])
def test_the_child_is_ticked_at_its_rate(hz: str, expected: str) -> None:
    clock = ManualClock()
    tree = nav2_tree(RateController, ["S"], f'hz="{hz}"', clock=clock)
    found = ""
    for _ in expected:
        found += ticks(tree, 1)
        tree.nodes[0].status = tree.nodes[0].status.RUNNING  # as under a parent that keeps it active
        clock.advance(0.1666667)
    assert found == expected
