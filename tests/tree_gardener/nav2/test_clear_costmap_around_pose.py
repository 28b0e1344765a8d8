"""ClearCostmapAroundPose of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Services
from tree_gardener import Status
from tree_gardener.nav2.clear_costmap_around_pose import ClearCostmapAroundPose

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_pose_and_size_are_sent(ros: Graph) -> None:
    service = Services(ros, "ClearCostmapAroundPose", "clear")
    body = "<ClearCostmapAroundPose service_name='clear' pose='1;2;0' reset_distance='2.5'/>"
    assert ros.run(body) is Status.SUCCESS
    (request,) = service.requests
    assert (request.pose.pose.position.y, request.reset_distance) == (2.0, 2.5)
    assert ClearCostmapAroundPose.SERVICE_TYPE == "nav2_msgs/srv/ClearCostmapAroundPose"
