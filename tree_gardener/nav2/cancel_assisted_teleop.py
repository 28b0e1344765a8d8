"""CancelAssistedTeleop of Nav2."""

from tree_gardener.nav2.cancel_leaf import Nav2Cancel
from tree_gardener.ports import Port


class CancelAssistedTeleop(Nav2Cancel):
    """Cancels all goals of the action assisted_teleop.

    Rule: Nav2's plugins/action/assisted_teleop_cancel_node.cpp.
    """

    ACTION_NAME = "assisted_teleop"
    INPUT_PORTS = {
        "server_name": Port(str, description="Name of the action; assisted_teleop if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
