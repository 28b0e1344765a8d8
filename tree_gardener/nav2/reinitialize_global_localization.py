"""ReinitializeGlobalLocalization of Nav2."""

from tree_gardener.nav2.action_leaf import Nav2Service
from tree_gardener.ports import Port


class ReinitializeGlobalLocalization(Nav2Service):
    """Spreads the particles of the localisation over the map again.

    Rule: Nav2's plugins/action/reinitialize_global_localization_service.cpp.
    """

    SERVICE_TYPE = "std_srvs/srv/Empty"
    INPUT_PORTS = {
        "service_name": Port(str, description="Name of the service."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
