"""ControllerSelector of Nav2."""

from tree_gardener.nav2.selector import Selector
from tree_gardener.ports import Port


class ControllerSelector(Selector):
    """Writes the name of the controller that was last received on the topic, or the default until then.

    It fails if there is neither. Rule: Nav2's plugins/action/controller_selector_node.cpp.
    """

    NODE_KIND = "SyncAction"
    WHAT = "controller"
    INPUT_PORTS = {
        "topic_name": Port(str, default="controller_selector", description="Topic of the names."),
        "default_controller": Port(str, description="The name until one is received."),
    }
    OUTPUT_PORTS = {"selected_controller": Port(str, description="The name.")}
