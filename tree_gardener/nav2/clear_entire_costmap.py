"""ClearEntireCostmap of Nav2."""

from tree_gardener.nav2.action_leaf import Nav2Service
from tree_gardener.ports import Port


class ClearEntireCostmap(Nav2Service):
    """Clears a costmap.

    Rule: Nav2's plugins/action/clear_costmap_service.cpp.
    """

    SERVICE_TYPE = "nav2_msgs/srv/ClearEntireCostmap"
    INPUT_PORTS = {
        "service_name": Port(str, description="Name of the service."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
        "plugins": Port(description="Not used: the costmap has no layers here."),
    }
