"""ToggleCollisionMonitor of Nav2."""

from typing import Any

from tree_gardener.nav2.action_leaf import Nav2Service
from tree_gardener.ports import Port


class ToggleCollisionMonitor(Nav2Service):
    """Turns the collision monitor on or off.

    Rule: Nav2's plugins/action/toggle_collision_monitor_service.cpp.
    """

    SERVICE_TYPE = "nav2_msgs/srv/Toggle"
    INPUT_PORTS = {
        "enable": Port(bool, default=True, description="Whether the monitor is on."),
        "service_name": Port(str, description="Name of the service."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }

    def set_request(self, request: Any) -> None:
        request.enable = bool(self.read("enable"))
