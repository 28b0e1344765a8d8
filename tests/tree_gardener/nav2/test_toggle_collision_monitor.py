"""ToggleCollisionMonitor of Nav2, with a real server."""

from __future__ import annotations

from typing import TYPE_CHECKING

from tests.tree_gardener.nav2_servers import Services
from tree_gardener import Status
from tree_gardener.nav2.toggle_collision_monitor import ToggleCollisionMonitor

if TYPE_CHECKING:
    from tests.tree_gardener.ros_graph import Graph


def test_it_is_turned_off_and_on(ros: Graph) -> None:
    service = Services(ros, "Toggle", "monitor", success=True)
    assert ToggleCollisionMonitor.SERVICE_TYPE == "nav2_msgs/srv/Toggle"
    assert ros.run("<ToggleCollisionMonitor service_name='monitor' enable='false'/>") is Status.SUCCESS
    assert ros.run("<ToggleCollisionMonitor service_name='monitor'/>") is Status.SUCCESS
    assert [request.enable for request in service.requests] == [False, True]
