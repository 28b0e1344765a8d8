"""CancelSpin of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Actions, cancelled_by
from tree_gardener.nav2.cancel_spin import CancelSpin

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_goal_under_way_is_cancelled(ros: Graph) -> None:
    server = Actions(ros, "Spin", CancelSpin.ACTION_NAME, outcome="wait")
    assert cancelled_by(ros, server, CancelSpin) == 1
