"""PathHandlerSelector of Nav2."""

from tree_gardener.nav2.selector import Selector
from tree_gardener.ports import Port


class PathHandlerSelector(Selector):
    """Writes the name of the path handler that was last received on the topic, or the default until then.

    It fails if there is neither. Rule: Nav2's plugins/action/path_handler_selector_node.cpp.
    """

    NODE_KIND = "SyncAction"
    WHAT = "path_handler"
    INPUT_PORTS = {
        "topic_name": Port(str, default="path_handler_selector", description="Topic of the names."),
        "default_path_handler": Port(str, description="The name until one is received."),
    }
    OUTPUT_PORTS = {"selected_path_handler": Port(str, description="The name.")}
