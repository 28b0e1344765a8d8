"""SmootherSelector of Nav2."""

from tree_gardener.nav2.selector import Selector
from tree_gardener.ports import Port


class SmootherSelector(Selector):
    """Writes the name of the smoother that was last received on the topic, or the default until then.

    It fails if there is neither. Rule: Nav2's plugins/action/smoother_selector_node.cpp.
    """

    NODE_KIND = "SyncAction"
    WHAT = "smoother"
    INPUT_PORTS = {
        "topic_name": Port(str, default="smoother_selector", description="Topic of the names."),
        "default_smoother": Port(str, description="The name until one is received."),
    }
    OUTPUT_PORTS = {"selected_smoother": Port(str, description="The name.")}
