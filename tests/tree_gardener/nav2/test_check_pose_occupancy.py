"""CheckPoseOccupancy of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.tree_gardener.nav2.test_cost_leaf import Costmap
from tree_gardener import Status
from tree_gardener.nav2.check_pose_occupancy import CheckPoseOccupancy

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


@pytest.mark.parametrize(
    ("cost", "ports", "expected"),
    [
        (254, "", Status.SUCCESS),
        (253, "", Status.FAILURE),
        (253, "cost_threshold='253'", Status.SUCCESS),
        (255, "", Status.FAILURE),
        (255, "consider_unknown_as_obstacle='true'", Status.SUCCESS),
        (-1, "", Status.FAILURE),
    ],
)
def test_an_occupied_pose_succeeds(ros: Graph, cost: int, ports: str, expected: Status) -> None:
    ros.nodes = {"CheckPoseOccupancy": CheckPoseOccupancy}
    costmap = Costmap(ros, "costs", x1=cost)
    assert ros.run(f"<CheckPoseOccupancy pose='1;0;0' service_name='costs' {ports}/>") is expected
    assert costmap.requests[0].use_footprint
