"""ExtractRouteNodesAsGoals of Nav2."""

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from tree_gardener.nav2.reading import give, input_or
from tree_gardener.nav2.topics import message_class
from tree_gardener.ports import Port


class ExtractRouteNodesAsGoals(Behaviour):
    """Writes the nodes of a route as goals, with the route's header. It fails if the route has none.

    Rule: Nav2's plugins/action/extract_route_nodes_as_goals_action.cpp.
    """

    NODE_KIND = "SyncAction"
    INPUT_PORTS = {"route": Port(description="The route: nav2_msgs/Route.")}
    OUTPUT_PORTS = {"goals": Port(description="The goals.")}

    def update(self) -> Status:
        route = input_or(self, "route", None)
        if route is None or not route.nodes:
            return Status.FAILURE
        pose_class = message_class("geometry_msgs", "PoseStamped")
        goals = message_class("nav_msgs", "Goals")(header=route.header)
        for node in route.nodes:
            goal = pose_class(header=route.header)
            goal.pose.position.x, goal.pose.position.y = node.position.x, node.position.y
            goals.goals.append(goal)
        give(self, "goals", goals)
        return Status.SUCCESS
