"""CancelComputeAndTrackRoute of Nav2."""

from tree_gardener.nav2.cancel_leaf import Nav2Cancel
from tree_gardener.ports import Port


class CancelComputeAndTrackRoute(Nav2Cancel):
    """Cancels all goals of the action compute_and_track_route.

    Rule: Nav2's plugins/action/compute_and_track_route_cancel_node.cpp.
    """

    ACTION_NAME = "compute_and_track_route"
    INPUT_PORTS = {
        "server_name": Port(
            str, description="Name of the action; compute_and_track_route if it is not given."
        ),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
