"""CancelDriveOnHeading of Nav2."""

from tree_gardener.nav2.cancel_leaf import Nav2Cancel
from tree_gardener.ports import Port


class CancelDriveOnHeading(Nav2Cancel):
    """Cancels all goals of the action drive_on_heading.

    Rule: Nav2's plugins/action/drive_on_heading_cancel_node.cpp.
    """

    ACTION_NAME = "drive_on_heading"
    INPUT_PORTS = {
        "server_name": Port(str, description="Name of the action; drive_on_heading if it is not given."),
        "server_timeout": Port(int, description="Time for the answer of the server, in ms; at least 500."),
    }
