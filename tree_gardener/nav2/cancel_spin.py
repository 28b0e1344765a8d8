"""CancelSpin of Nav2."""

from tree_gardener.nav2.cancel_leaf import Nav2Cancel
from tree_gardener.ports import Port


class CancelSpin(Nav2Cancel):
    """Cancels all goals of the action spin.

    Rule: Nav2's plugins/action/spin_cancel_node.cpp.
    """

    ACTION_NAME = "spin"
    INPUT_PORTS = {
        "server_name": Port(str, description="Name of the action; spin if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
