"""PlannerSelector of Nav2."""

from tree_gardener.nav2.selector import Selector
from tree_gardener.ports import Port


class PlannerSelector(Selector):
    """Writes the name of the planner that was last received on the topic, or the default until then.

    It fails if there is neither. Rule: Nav2's plugins/action/planner_selector_node.cpp.
    """

    NODE_KIND = "SyncAction"
    WHAT = "planner"
    INPUT_PORTS = {
        "topic_name": Port(str, default="planner_selector", description="Topic of the names."),
        "default_planner": Port(str, description="The name until one is received."),
    }
    OUTPUT_PORTS = {"selected_planner": Port(str, description="The name.")}
