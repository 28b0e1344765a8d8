"""CancelFollowObject of Nav2."""

from tree_gardener.nav2.cancel_leaf import Nav2Cancel
from tree_gardener.ports import Port


class CancelFollowObject(Nav2Cancel):
    """Cancels all goals of the action follow_object.

    Rule: Nav2's plugins/action/follow_object_cancel_node.cpp.
    """

    ACTION_NAME = "follow_object"
    INPUT_PORTS = {
        "server_name": Port(str, description="Name of the action; follow_object if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
