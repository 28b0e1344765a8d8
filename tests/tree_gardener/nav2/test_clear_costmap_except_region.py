"""ClearCostmapExceptRegion of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Services
from tree_gardener import Status
from tree_gardener.nav2.clear_costmap_except_region import ClearCostmapExceptRegion

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_the_size_of_the_region_is_sent(ros: Graph) -> None:
    assert ClearCostmapExceptRegion.SERVICE_NAME == ""  # a tree has to name the costmap
    service = Services(ros, "ClearCostmapExceptRegion", "clear")
    assert ros.run("<ClearCostmapExceptRegion service_name='clear' reset_distance='2.5'/>") is Status.SUCCESS
    assert ros.run("<ClearCostmapExceptRegion service_name='clear'/>") is Status.SUCCESS
    assert [request.reset_distance for request in service.requests] == [2.5, 1.0]
