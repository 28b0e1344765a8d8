"""ClearCostmapAroundRobot of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Service
from tree_gardener.ports import Port


class ClearCostmapAroundRobot(Nav2Service):
    """Clears a costmap around the robot.

    Rule: Nav2's plugins/action/clear_costmap_service.cpp.
    """

    SERVICE_TYPE = "nav2_msgs/srv/ClearCostmapAroundRobot"
    INPUT_PORTS = {
        "reset_distance": Port(float, default=1.0, description="The size of the region, in m."),
        "service_name": Port(str, description="Name of the service."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
        "plugins": Port(description="Not used: the costmap has no layers here."),
    }

    def set_request(self, request: Any) -> None:
        request.reset_distance = float(self.read("reset_distance"))
