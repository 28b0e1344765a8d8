"""GoalCheckerSelector of Nav2."""

from tree_gardener.nav2.selector import Selector
from tree_gardener.ports import Port


class GoalCheckerSelector(Selector):
    """Writes the name of the goal checker that was last received on the topic, or the default until then.

    It fails if there is neither. Rule: Nav2's plugins/action/goal_checker_selector_node.cpp.
    """

    NODE_KIND = "SyncAction"
    WHAT = "goal_checker"
    INPUT_PORTS = {
        "topic_name": Port(str, default="goal_checker_selector", description="Topic of the names."),
        "default_goal_checker": Port(str, description="The name until one is received."),
    }
    OUTPUT_PORTS = {"selected_goal_checker": Port(str, description="The name.")}
